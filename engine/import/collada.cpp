#include "engine/import/collada.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/import/xml.hpp"
#include "engine/import/xml_unit.hpp"
#include "engine/mesh_file.hpp"
#include "engine/polygon.hpp"

namespace cullet {
namespace {

constexpr int64_t kLargestOffset = 1000;  // of an input; files have two or three
constexpr int64_t kRestart = -1;
constexpr unsigned kDepthOfUnit = 3;  // COLLADA, asset, unit; meshes may have assets of their own, which do not count

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    return out;
}

std::string tag(std::string_view name, XmlListener::Attributes attributes, std::string_view but = "") {
    std::string out = "<" + std::string(name);
    for (; *attributes != nullptr; attributes += 2)
        if (attributes[0] != but) out += " " + std::string(attributes[0]) + "=\"" + escaped(attributes[1]) + "\"";
    return out;
}

/// One `tristrips` or `trifans` while it is read.
struct Strips {
    bool is_open = false, is_fan = false;
    size_t first_byte = 0;
    std::string prefix, tag, inputs;
    size_t stride = 1, vertex_offset = 0;
    std::vector<std::vector<int64_t>> lists;  // one a `p`
};

using Corner = const int64_t*;  // as many numbers as the stride

std::string numbers(Corner corner, size_t stride) {
    std::string out;
    for (size_t i = 0; i < stride; ++i) out += std::to_string(corner[i]) + " ";
    return out;
}

/// The triangles of one list, appended as text. Returns how many.
uint64_t append_triangles(std::string& out, const std::vector<int64_t>& list, const Strips& strips) {
    const size_t stride = strips.stride, count = list.size() / stride;
    const auto vertex = [&](size_t i) { return list[i * stride + strips.vertex_offset]; };
    uint64_t triangles = 0;
    for (size_t begin = 0; begin < count;) {
        size_t end = begin;
        while (end < count && vertex(end) != kRestart) ++end;
        for (size_t t = 0; begin + t + 2 < end; ++t) {
            const auto [a, b, c] = strips.is_fan ? corners_in_fan(t) : corners_in_strip(t);
            const int64_t first = vertex(begin + a), second = vertex(begin + b), third = vertex(begin + c);
            if (first == second || second == third || third == first) continue;
            for (const size_t corner : {a, b, c}) out += numbers(list.data() + (begin + corner) * stride, stride);
            ++triangles;
        }
        begin = end + 1;
    }
    return triangles;
}

class ColladaListener : public XmlListener {
 public:
    ColladaListener(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

    void begin(std::string_view name, Attributes attributes) override {
        ++depth_;
        if (left_out_depth_ > 0) return;
        const std::string_view local = without_prefix(name);
        if (local == "tristrips" || local == "trifans") {
            open_strips(name, local, attributes);
        } else if (strips_.is_open && local == "input") {
            take_input(name, attributes);
        } else if (local == "p") {
            text_.clear();
            is_listening_ = strips_.is_open;
        } else if (local == "h") {
            leave_out();
        } else if (local == "ph") {
            drop(first_byte(), byte_count());
            ++counts_["ph"];
        } else {
            look_at(local, attributes);
        }
    }

    void end(std::string_view name) override {
        const unsigned depth = depth_--;
        if (left_out_depth_ > 0) {
            if (depth != left_out_depth_) return;
            drop(left_out_byte_, first_byte() + byte_count() - left_out_byte_);
            left_out_depth_ = 0;
            return;
        }
        const std::string_view local = without_prefix(name);
        if (local == "p" && is_listening_) take_list();
        if (local == "ph") drop(first_byte(), byte_count());
        if (local == "up_axis" && is_up_axis_) take_up_axis();
        if ((local == "tristrips" || local == "trifans") && strips_.is_open) close_strips();
    }

    void text(std::string_view piece) override {
        if (is_listening_ || is_up_axis_) text_ += piece;
    }

    Result<PlainCollada> finished() {
        if (!trouble_.empty()) return Error{trouble_};
        for (const std::string& id : named_) counts_["lost"] += ids_.count(id) == 0;
        PlainCollada out;
        out.notes = notes();
        if (copied_ == 0) {
            out.text = bytes_;
            return out;
        }
        out.text = std::move(out_);
        out.text += bytes_.substr(copied_);
        return out;
    }

 private:
    /// From here to the end of this element.
    void leave_out() {
        left_out_depth_ = depth_;
        left_out_byte_ = first_byte();
    }

    void say(const std::string& what) {
        if (trouble_.empty()) trouble_ = path_ + ": " + what + ". Repair the file or export it again.";
    }

    /// Copies what stands before, and leaves out so many bytes.
    void drop(size_t first, size_t size) {
        if (strips_.is_open || first < copied_) return;
        out_ += bytes_.substr(copied_, first - copied_);
        copied_ = std::min(first + size, bytes_.size());
    }

    void open_strips(std::string_view name, std::string_view local, Attributes attributes) {
        strips_ = {};
        strips_.is_open = true;
        strips_.is_fan = local == "trifans";
        strips_.first_byte = first_byte();
        strips_.prefix = name.substr(0, name.size() - local.size());
        strips_.tag = tag(strips_.prefix + "triangles", attributes, "count");
    }

    void take_input(std::string_view name, Attributes attributes) {
        strips_.inputs += tag(name, attributes) + "/>";
        const char* const text = attribute(attributes, "offset");
        const auto offset = number_of(text != nullptr ? text : "0");
        if (!offset || !(*offset >= 0 && *offset <= static_cast<double>(kLargestOffset))) {
            say("an input has the offset \"" + one_line(text != nullptr ? text : "", 40) + "\"");
            return;
        }
        strips_.stride = std::max(strips_.stride, static_cast<size_t>(*offset) + 1);
        const char* const semantic = attribute(attributes, "semantic");
        if (semantic != nullptr && std::string_view(semantic) == "VERTEX")
            strips_.vertex_offset = static_cast<size_t>(*offset);
    }

    void take_list() {
        is_listening_ = false;
        std::vector<int64_t> list;
        Words words(text_);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const auto number = number_of(word);
            if (!number || !(*number >= -1 && *number < 4294967296.0) || *number != std::floor(*number)) {
                say("a strip or fan names vertex \"" + one_line(std::string(word), 40) + "\"");
                return;
            }
            list.push_back(static_cast<int64_t>(*number));
        }
        strips_.lists.push_back(std::move(list));
    }

    void close_strips() {
        std::string list;
        uint64_t triangles = 0;
        for (const auto& numbers : strips_.lists) {
            if (numbers.size() % strips_.stride != 0)
                say("a strip or fan has " + std::to_string(numbers.size()) + " numbers, " +
                    std::to_string(strips_.stride) + " a corner");
            triangles += append_triangles(list, numbers, strips_);
        }
        const size_t end = first_byte() + byte_count();
        strips_.is_open = false;
        drop(strips_.first_byte, end - strips_.first_byte);
        if (triangles == 0) return;
        const std::string& prefix = strips_.prefix;
        out_ += strips_.tag + " count=\"" + std::to_string(triangles) + "\">" + strips_.inputs + "<" + prefix + "p>" +
                list + "</" + prefix + "p></" + prefix + "triangles>";
    }

    void look_at(std::string_view local, Attributes attributes) {
        const auto is_any_of = [local](std::initializer_list<const char*> names) {
            return std::find(names.begin(), names.end(), local) != names.end();
        };
        if (is_any_of({"geometry", "controller", "node"}))
            for (const char* name : {"id", "name"})
                if (const char* const id = attribute(attributes, name)) ids_.insert(id);
        if (is_any_of({"instance_geometry", "instance_controller", "instance_node"}))
            if (!look_for(attribute(attributes, "url"))) leave_out();
        if (is_any_of({"skin", "morph"})) look_for(attribute(attributes, "source"));
        if (is_any_of({"spline", "convex_mesh", "brep", "skew"})) ++counts_[std::string(local)];
        if (local == "skew") leave_out();  // assimp 5.2 ends in abort() at it
        if (local == "unit" && depth_ == kDepthOfUnit) check_unit(attributes);
        if (local == "up_axis" && depth_ == kDepthOfUnit) {
            text_.clear();
            is_up_axis_ = true;
            up_axis_byte_ = first_byte() + byte_count();
        }
    }

    /// False for what is in another file: assimp refuses a file that names one, and passes over what is not there
    /// without a word.
    bool look_for(const char* url) {
        if (url == nullptr) return true;
        if (url[0] != '#') {
            ++counts_["url"];
            return false;
        }
        named_.push_back(url + 1);
        return true;
    }

    void check_unit(Attributes attributes) {
        const char* const metres = attribute(attributes, "meter");
        if (metres != nullptr && !is_length(number_of(Words(metres).next())))
            say("its unit is \"" + one_line(metres, 40) + "\" m, which is no length");
    }

    // assimp takes all but two spellings for y, without a word: blanks beside them make others.
    void take_up_axis() {
        is_up_axis_ = false;
        const std::string word(Words(text_).peek());
        constexpr std::array<const char*, 3> kKnown{"X_UP", "Y_UP", "Z_UP"};
        if (std::find(kKnown.begin(), kKnown.end(), text_) != kKnown.end()) return;
        for (const char* known : kKnown) {
            if (small_letters(word) != small_letters(known)) continue;
            drop(up_axis_byte_, first_byte() - up_axis_byte_);
            out_ += known;
            return;
        }
        say("its up axis is \"" + one_line(word, 40) + "\", which is none of X_UP, Y_UP and Z_UP");
    }

    std::vector<std::string> notes() const {
        constexpr struct {
            const char *key, *one, *many;
        } kNotes[] = {
            {"ph", "polygon came without the holes in it.", "polygons came without the holes in them."},
            {"url", "mesh or node of other files was left out.", "meshes or nodes of other files were left out."},
            {"lost", "mesh or node that is named but not in the file was left out.",
             "meshes or nodes that are named but not in the file were left out."},
            {"spline", "spline was left out.", "splines were left out."},
            {"convex_mesh", "convex_mesh was left out.", "convex_meshes were left out."},
            {"brep", "brep was left out.", "breps were left out."},
            {"skew", "skew of nodes was left out: such nodes stand wrong.",
             "skews of nodes were left out: such nodes stand wrong."}};
        std::vector<std::string> all;
        for (const auto& note : kNotes) {
            const auto found = counts_.find(note.key);
            if (found == counts_.end() || found->second == 0) continue;
            all.push_back(counted(found->second, note.one, note.many));
        }
        return all;
    }

    std::string_view bytes_;
    const std::string& path_;
    std::string out_, text_, trouble_;
    size_t copied_ = 0, left_out_byte_ = 0;  // bytes
    unsigned depth_ = 0;                     // 1 in the first element
    unsigned left_out_depth_ = 0;            // of the element that is being left out; 0 outside of such
    Strips strips_;
    bool is_listening_ = false, is_up_axis_ = false;
    size_t up_axis_byte_ = 0;  // where its text begins
    std::map<std::string, uint64_t> counts_;
    std::set<std::string> ids_;       // of what can stand at a node
    std::vector<std::string> named_;  // of these, by nodes
};

}  // namespace

Result<PlainCollada> plain_collada(std::string bytes, const std::string& path) {
    const std::string plain = plain_xml(std::move(bytes));
    ColladaListener listener(plain, path);
    if (auto r = read_xml(plain, listener, path); !r) {
        // assimp takes XML that is none, such as a bare & in a name; where nothing is to be changed, it may.
        for (const char* name : {"tristrips", "trifans", "<ph", "skew"})
            if (plain.find(name) != plain.npos) return Error{r.error()};
        return PlainCollada{plain, {}};
    }
    return listener.finished();
}

}  // namespace cullet
