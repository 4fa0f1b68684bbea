#include "engine/import/three_mf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/import/xml.hpp"
#include "engine/import/xml_unit.hpp"
#include "engine/import/zip.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr size_t kMostParts = 4096;  // files of XML in one model
constexpr int kDeepest = 64;         // components in components
constexpr uint32_t kNone = ~0u;
constexpr uint16_t kNoMaterial = 65535;  // becomes the number after the last

/// An object at a place: an item of the build, or a component.
struct Use {
    std::string object;  // its number in its part
    std::string part;    // "" for the part that names it
    Affine place;
};

/// What `pid` names: a list of which triangles and objects take one by its number.
struct Group {
    enum class Kind : uint8_t { Materials, Coordinates, Colours, Mixed };
    Kind kind = Kind::Colours;
    uint32_t count = 0;  // of materials
    uint32_t first = 0;  // number of its first material in the whole file
    std::vector<Vec2> coordinates;
};

/// Which of them, by name, until all groups are known.
struct Property {
    uint32_t group = kNone;  // a row of Part::groups
    uint32_t number[3] = {kNone, kNone, kNone};
};

struct Object {
    std::vector<Vec3d> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<Property> properties;  // one a triangle, once there is one; those left are the object's own
    Property own;
    std::vector<Use> components;
    bool is_used = false, is_support = false;
};

/// One file of XML.
struct Part {
    std::optional<double> unit;  // m
    std::map<std::string, Object> objects;
    std::vector<std::string> order;  // of the objects
    std::vector<Use> items;
    std::vector<Group> groups;
    std::map<std::string, uint32_t> group_of;  // by number; also of those that are only named
    uint64_t beams = 0;
    std::string trouble, remedy;  // the first, without the file's name; and what to do
};

/// Extensions that change no shape, or that are read.
bool is_known_extension(std::string_view space) {
    for (const char* known : {"/3dmanufacturing/production/", "/3dmanufacturing/material/", "/3dmanufacturing/core/",
                              "/3dmanufacturing/trianglesets/"})
        if (space.find(known) != space.npos) return true;
    return false;
}

class PartListener : public XmlListener {
 public:
    explicit PartListener(Part& part) : part_(part) {}

    void begin(std::string_view name, Attributes attributes) override {
        const std::string_view local = without_prefix(name);
        for (Attributes a = attributes; *a != nullptr; a += 2)
            if (std::string_view(a[0]).rfind("xmlns:", 0) == 0) spaces_[a[0] + 6] = a[1];
        if (local == "model") begin_model(attributes);
        if (local == "object") begin_object(attributes);
        if (local == "vertex" && object_ != nullptr) append_vertex(attributes);
        if (local == "triangle" && object_ != nullptr) append_triangle(attributes);
        if (local == "component" && object_ != nullptr) append_use(object_->components, attributes);
        if (local == "item") append_use(part_.items, attributes);
        part_.beams += local == "beam";
        begin_group(local, attributes);
    }
    void end(std::string_view name) override {
        if (without_prefix(name) == "object") object_ = nullptr;
    }

 private:
    void say(const std::string& trouble, const std::string& remedy = "Repair the file or export it again.") {
        if (!part_.trouble.empty()) return;
        part_.trouble = trouble;
        part_.remedy = remedy;
    }

    uint32_t group_of(const std::string& id) {
        const auto [found, is_new] = part_.group_of.try_emplace(id, static_cast<uint32_t>(part_.groups.size()));
        if (is_new) part_.groups.emplace_back();
        return found->second;
    }

    void begin_group(std::string_view local, Attributes attributes) {
        constexpr std::pair<std::string_view, Group::Kind> kKinds[] = {{"basematerials", Group::Kind::Materials},
                                                                       {"texture2dgroup", Group::Kind::Coordinates},
                                                                       {"colorgroup", Group::Kind::Colours},
                                                                       {"compositematerials", Group::Kind::Mixed},
                                                                       {"multiproperties", Group::Kind::Mixed}};
        for (const auto& [name, kind] : kKinds) {
            if (local != name) continue;
            const char* const id = attribute(attributes, "id");
            open_group_ = group_of(id != nullptr ? id : "");
            part_.groups[open_group_] = {};
            part_.groups[open_group_].kind = kind;
        }
        if (open_group_ == kNone) return;
        Group& group = part_.groups[open_group_];
        group.count += local == "base" && group.kind == Group::Kind::Materials;
        if (local != "tex2coord" || group.kind != Group::Kind::Coordinates) return;
        const auto value = [&](const char* name) {
            const char* const text = attribute(attributes, name);
            return static_cast<float>((text != nullptr ? number_of(text) : std::nullopt).value_or(NAN));
        };
        group.coordinates.push_back({value("u"), value("v")});
    }

    /// A whole number below 2^32 - 1, or kNone.
    static uint32_t row_in(Attributes attributes, const char* name) {
        const char* const text = attribute(attributes, name);
        const auto number = text != nullptr ? number_of(text) : std::nullopt;
        const bool is_row = number && *number >= 0 && *number < 4294967295.0 && *number == std::floor(*number);
        return is_row ? static_cast<uint32_t>(*number) : kNone;
    }

    /// A triangle takes what it does not say from its object; a corner what it does not say from the first.
    void append_property(Attributes attributes) {
        Property property = object_->own;
        const char* const group = attribute(attributes, "pid");
        if (group != nullptr) property.group = group_of(group);
        const char* const names[3] = {"p1", "p2", "p3"};
        if (attribute(attributes, "p1") != nullptr)
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t number = row_in(attributes, names[c]);
                property.number[c] = number != kNone ? number : property.number[0];
            }
        if (property.group == kNone && object_->properties.empty()) return;
        object_->properties.resize(object_->triangles.size(), object_->own);
        object_->properties.push_back(property);
    }

    void begin_model(Attributes attributes) {
        if (const char* unit = attribute(attributes, "unit")) {
            part_.unit = metres_of(small_letters(unit));
            if (!part_.unit)
                say("its unit is \"" + one_line(unit, 40) +
                    "\", none of micron, millimeter, centimeter, inch, foot and meter");
        }
        const char* required = attribute(attributes, "requiredextensions");
        if (required == nullptr) return;
        Words prefixes(required);
        for (std::string_view prefix = prefixes.next(); !prefix.empty(); prefix = prefixes.next()) {
            const auto space = spaces_.find(std::string(prefix));
            const std::string extension = space == spaces_.end() ? std::string(prefix) : space->second;
            if (!is_known_extension(extension))
                say("it requires the extension \"" + one_line(extension, 200) + "\", which is not read",
                    "Export the model without it.");
        }
    }

    void begin_object(Attributes attributes) {
        const char* id = attribute(attributes, "id");
        const std::string key = id != nullptr ? id : "";
        const auto [found, is_new] = part_.objects.try_emplace(key);
        if (!is_new) say("two objects have the number \"" + one_line(key, 40) + "\"");
        if (is_new) part_.order.push_back(key);
        object_ = &found->second;
        if (const char* const group = attribute(attributes, "pid")) object_->own.group = group_of(group);
        for (uint32_t& number : object_->own.number) number = row_in(attributes, "pindex");
        const char* const type = attribute(attributes, "type");
        object_->is_support = type != nullptr && (is_word(type, "support") || is_word(type, "solidsupport"));
    }

    double number(Attributes attributes, const char* name) {
        const char* const value = attribute(attributes, name);
        const auto number = value != nullptr ? number_of(value) : std::nullopt;
        if (!number)
            say(std::string("a vertex has no number \"") + name + "\"" +
                (value != nullptr ? " but \"" + one_line(value, 40) + "\"" : ""));
        return number ? *number : 0;
    }

    void append_vertex(Attributes attributes) {
        object_->vertices.push_back({number(attributes, "x"), number(attributes, "y"), number(attributes, "z")});
    }

    void append_triangle(Attributes attributes) {
        append_property(attributes);
        std::array<uint32_t, 3> triangle{};
        const char* const names[3] = {"v1", "v2", "v3"};
        for (size_t c = 0; c < 3; ++c) {
            const char* const value = attribute(attributes, names[c]);
            const auto number = value != nullptr ? number_of(value) : std::nullopt;
            if (number && *number >= 0 && *number < 4e9 && *number == static_cast<uint32_t>(*number))
                triangle[c] = static_cast<uint32_t>(*number);
            else
                say("triangle " + std::to_string(object_->triangles.size()) + " names vertex \"" +
                    one_line(value != nullptr ? value : "", 40) + "\"");
        }
        object_->triangles.push_back(triangle);
    }

    void append_use(std::vector<Use>& uses, Attributes attributes) {
        Use use;
        if (const char* id = attribute(attributes, "objectid")) use.object = id;
        if (const char* part = attribute(attributes, "path")) use.part = part;
        if (const char* transform = attribute(attributes, "transform")) use.place = place_of(transform);
        uses.push_back(use);
    }

    /// Twelve numbers, the rows of a matrix that a row of coordinates is multiplied with.
    Affine place_of(const char* transform) {
        double m[12] = {};
        Words words(transform);
        for (double& value : m) {
            const auto number = number_of(words.next());
            if (!number) say("the transform \"" + one_line(transform, 80) + "\" has not twelve numbers");
            value = number ? *number : 0;
        }
        if (!words.next().empty())
            say("the transform \"" + one_line(transform, 80) + "\" has more than twelve numbers");
        Affine place;
        place.row[0] = {m[0], m[3], m[6]};
        place.row[1] = {m[1], m[4], m[7]};
        place.row[2] = {m[2], m[5], m[8]};
        place.move = {m[9], m[10], m[11]};
        return place;
    }

    Part& part_;
    std::map<std::string, std::string> spaces_;  // prefix to name
    Object* object_ = nullptr;                   // a map keeps its values in place
    uint32_t open_group_ = kNone;
};

/// The part that the package begins with.
struct RelationListener : XmlListener {
    std::string target;
    void begin(std::string_view name, Attributes attributes) override {
        const char *type = attribute(attributes, "Type"), *to = attribute(attributes, "Target");
        if (without_prefix(name) == "Relationship" && type != nullptr && to != nullptr && target.empty() &&
            std::string_view(type).find("/3dmodel") != std::string_view::npos)
            target = to;
    }
};

class Reader {
 public:
    Reader(const ZipFile& zip, const std::string& path) : zip_(zip), path_(path) {}

    Result<Corners> read() {
        const auto root = part_of(root_name());
        if (!root) return Error{root.error()};
        unit_ = (*root)->unit.value_or(1e-3);
        std::vector<Use> items = (*root)->items;
        if (items.empty()) items = all_objects(**root);
        for (const Use& item : items)
            if (auto r = append_use(item, **root, scaled(unit_), 0); !r) return Error{r.error()};
        std::replace(out_.materials.begin(), out_.materials.end(), kNoMaterial, static_cast<uint16_t>(materials_));
        add_notes();
        return std::move(out_);
    }

 private:
    std::string root_name() const {
        RelationListener relations;
        if (const auto bytes = zip_.read("_rels/.rels"))
            if (read_xml(plain_xml(*bytes), relations, path_) && !relations.target.empty()) return relations.target;
        return "3D/3dmodel.model";
    }

    /// Each part is read once.
    Result<Part*> part_of(const std::string& name) {
        auto& part = parts_[name];
        if (part != nullptr) return part.get();
        if (parts_.size() > kMostParts)
            return Error{path_ + ": has more than " + std::to_string(kMostParts) + " parts. Split the model."};
        auto bytes = zip_.read(name);
        if (!bytes)
            return Error{path_ + ": its part \"" + one_line(name, 200) +
                         "\" is not there, encrypted or damaged. Copy or export it again."};
        part = std::make_unique<Part>();
        PartListener listener(*part);
        if (auto r = read_xml(plain_xml(std::move(*bytes)), listener, path_); !r) return Error{r.error()};
        if (!part->trouble.empty()) return Error{path_ + ": " + part->trouble + ". " + part->remedy};
        for (Group& group : part->groups) {
            group.first = materials_;
            if (group.count >= kNoMaterial - materials_)
                return Error{path_ + ": has more than 65534 materials. Merge some materials."};
            materials_ += group.count;
        }
        return part.get();
    }

    /// Of a model whose build is empty: those that are no component of another.
    std::vector<Use> all_objects(const Part& part) {
        std::set<std::string> components;
        for (const auto& [id, object] : part.objects)
            for (const Use& component : object.components) components.insert(component.object);
        std::vector<Use> uses;
        for (const std::string& id : part.order)
            if (components.count(id) == 0) uses.push_back({id, "", {}});
        if (!uses.empty()) out_.notes.push_back("Its build names nothing; every object was taken as it stands.");
        return uses;
    }

    Result<void> append_use(const Use& use, Part& from, const Affine& parent, int depth) {
        if (depth > kDeepest)
            return Error{path_ + ": has components in components more than " + std::to_string(kDeepest) +
                         " deep, or in a circle. Repair the file or export it again."};
        Part* part = &from;
        Affine place = chained(parent, use.place);
        if (!use.part.empty()) {
            const auto named = part_of(use.part);
            if (!named) return Error{named.error()};
            part = *named;
            place = chained(place, scaled(part->unit.value_or(unit_) / from.unit.value_or(unit_)));
        }
        const auto found = part->objects.find(use.object);
        if (found == part->objects.end())
            return Error{path_ + ": an item or component names object \"" + one_line(use.object, 40) +
                         "\", which is not there. Repair the file or export it again."};
        found->second.is_used = true;
        supports_ += found->second.is_support;
        if (found->second.is_support) return {};
        empty_ += found->second.triangles.empty() && found->second.components.empty();
        if (auto r = append_mesh(found->first, found->second, *part, place); !r) return r;
        for (const Use& component : found->second.components)
            if (auto r = append_use(component, *part, place, depth + 1); !r) return r;
        return {};
    }

    /// The material, or the texture coordinates, of triangle t.
    void put_property(SourceTriangle& triangle, const Object& object, const Part& part, size_t t) {
        triangle.material = kNoMaterial;
        const Property& property = t < object.properties.size() ? object.properties[t] : object.own;
        if (property.group == kNone) return;
        const Group& group = part.groups[property.group];
        mixed_ += group.kind == Group::Kind::Mixed;
        if (group.kind == Group::Kind::Materials) {
            const bool is_there = property.number[0] < group.count;
            if (is_there) triangle.material = static_cast<uint16_t>(group.first + property.number[0]);
            lost_ += !is_there;
        }
        if (group.kind != Group::Kind::Coordinates) return;
        triangle.has_uvs = true;
        for (size_t c = 0; c < 3; ++c) {
            const bool is_there = property.number[c] < group.coordinates.size();
            triangle.corner[c].uv = is_there ? group.coordinates[property.number[c]] : Vec2{NAN, NAN};
        }
    }

    Result<void> append_mesh(const std::string& id, const Object& object, const Part& part, const Affine& place) {
        UsedPoints used(object.vertices.size());
        for (size_t t = 0; t < object.triangles.size(); ++t) {
            SourceTriangle triangle;
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t v = object.triangles[t][c];
                if (v >= object.vertices.size())
                    return Error{path_ + ": triangle " + std::to_string(t) + " of object " + one_line(id, 40) +
                                 " names vertex " + std::to_string(v) + ", but there are " +
                                 std::to_string(object.vertices.size()) + ". Repair the file or export it again."};
                triangle.corner[c].position = object.vertices[v];
            }
            put_property(triangle, object, part, t);
            if (!append_triangle(out_, triangle, place)) continue;
            used.add(out_, object.triangles[t]);
        }
        return check_triangles(out_, path_);
    }

    void add_notes() {
        uint64_t unused = 0, beams = 0;
        for (const auto& [name, part] : parts_) {
            if (part == nullptr) continue;
            beams += part->beams;
            for (const auto& [id, object] : part->objects) unused += !object.is_used && !object.triangles.empty();
        }
        const auto say = [this](uint64_t n, const char* one, const char* many) {
            if (n > 0) out_.notes.push_back(counted(n, one, many));
        };
        say(unused, "object that the build does not name was left out.",
            "objects that the build does not name were left out.");
        say(supports_, "object that is a support was left out.", "objects that are supports were left out.");
        say(empty_, "object without triangles, such as one of slices alone, was left out.",
            "objects without triangles, such as those of slices alone, were left out.");
        say(beams, "beam of a lattice was left out.", "beams of a lattice were left out.");
        say(mixed_, "triangle of mixed materials has no material's number.",
            "triangles of mixed materials have no material's number.");
        say(lost_, "triangle names a material that is not there.", "triangles name materials that are not there.");
    }

    const ZipFile& zip_;
    const std::string& path_;
    std::map<std::string, std::unique_ptr<Part>> parts_;
    double unit_ = 1e-3;      // m, of the first part
    uint32_t materials_ = 0;  // of all parts so far
    uint64_t supports_ = 0, empty_ = 0, mixed_ = 0, lost_ = 0;
    Corners out_;
};

}  // namespace

Result<Corners> read_3mf(const std::string& file, const std::string& path) {
    const ZipFile zip(file);
    if (!zip.is_open()) return Error{path + ": is no ZIP file, as a 3MF is, or is cut off. Copy or export it again."};
    return Reader(zip, path).read();
}

}  // namespace cullet
