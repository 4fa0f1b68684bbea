#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <utility>

#include "engine/import/collada.hpp"
#include "engine/import/corners.hpp"
#include "engine/import/fbx_place.hpp"
#include "engine/import/folder_files.hpp"
#include "engine/import/gltf/read_gltf.hpp"
#include "engine/import/import.hpp"
#include "engine/import/ply.hpp"
#include "engine/import/stl.hpp"
#include "engine/import/text_encoding.hpp"
#include "engine/import/three_mf.hpp"
#include "engine/import/words.hpp"
#include "engine/import/xml.hpp"
#include "engine/import/xml_unit.hpp"
#include "engine/import/zip.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

Affine child_of(const Affine& parent, const aiMatrix4x4& m) {
    Affine child;
    child.row[0] = {m.a1, m.a2, m.a3};
    child.row[1] = {m.b1, m.b2, m.b3};
    child.row[2] = {m.c1, m.c2, m.c3};
    child.move = {m.a4, m.b4, m.c4};
    return chained(parent, child);
}

std::string mesh_title(const aiScene& scene, unsigned m) {
    return "mesh " + std::to_string(m) + " \"" + scene.mMeshes[m]->mName.C_Str() + "\"";
}

/// assimp hands indices on unread; its own post-processing would follow them past the end.
Result<void> check_indices(const aiScene& scene, const std::string& path) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned c = 0; c < mesh.mFaces[f].mNumIndices; ++c)
                if (mesh.mFaces[f].mIndices[c] >= mesh.mNumVertices)
                    return Error{path + ": face " + std::to_string(f) + " of " + mesh_title(scene, m) +
                                 " names vertex " + std::to_string(mesh.mFaces[f].mIndices[c]) + ", but there are " +
                                 std::to_string(mesh.mNumVertices) + ". Repair the file or export it again."};
    }
    return {};
}

Vec3d vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

SourceTriangle triangle_of(const aiMesh& mesh, const aiFace& face) {
    SourceTriangle triangle;
    triangle.has_normals = mesh.HasNormals();
    triangle.has_uvs = mesh.HasTextureCoords(0);
    triangle.material = static_cast<uint16_t>(mesh.mMaterialIndex);
    for (unsigned c = 0; c < 3; ++c) {
        const unsigned v = face.mIndices[c];
        triangle.corner[c].position = vector_of(mesh.mVertices[v]);
        if (triangle.has_normals) triangle.corner[c].normal = vector_of(mesh.mNormals[v]);
        if (triangle.has_uvs) triangle.corner[c].uv = {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
    }
    return triangle;
}

/// One mesh at one of its places.
void append_mesh(Corners& out, const aiMesh& mesh, const Affine& place) {
    std::vector<bool> is_used(mesh.mNumVertices);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        out.left_out += face.mNumIndices == 1 || face.mNumIndices == 2;
        if (face.mNumIndices != 3) continue;
        if (!append_triangle(out, triangle_of(mesh, face), place)) continue;
        for (unsigned c = 0; c < 3; ++c) {
            out.points += !is_used[face.mIndices[c]];
            is_used[face.mIndices[c]] = true;
        }
    }
}

Result<Corners> gather(const aiScene& scene, const std::string& path, const Affine& root) {
    Corners corners;
    struct Item {
        const aiNode* node;
        Affine parent;
    };
    std::vector<Item> stack;
    if (scene.mRootNode != nullptr) stack.push_back({scene.mRootNode, root});
    while (!stack.empty()) {
        const Item item = stack.back();
        stack.pop_back();
        const Affine place = child_of(item.parent, item.node->mTransformation);
        for (unsigned i = 0; i < item.node->mNumMeshes; ++i) {
            const unsigned m = item.node->mMeshes[i];
            if (m >= scene.mNumMeshes)
                return Error{path + ": a node names mesh " + std::to_string(m) + ", but there are " +
                             std::to_string(scene.mNumMeshes) + ". Repair the file or export it again."};
            const aiMesh& mesh = *scene.mMeshes[m];
            if (mesh.mMaterialIndex > 65535)
                return Error{path + ": " + mesh_title(scene, m) + " has material " +
                             std::to_string(mesh.mMaterialIndex) + ", above 65535. Merge some materials."};
            append_mesh(corners, mesh, place);
            if (corners.materials.size() > kMostMeshRows)
                return Error{path + ": has more than " + std::to_string(kMostMeshRows) +
                             " triangles. Split the model."};
        }
        for (unsigned i = item.node->mNumChildren; i-- > 0;) stack.push_back({item.node->mChildren[i], place});
    }
    return corners;
}

// Assimp catches what a failed allocation throws and says anything from "std::bad_alloc" to "Unknown exception", by
// where it failed. So the program notes it; nobody but its child, which reads one file and ends, asks for it.
bool has_run_out_of_memory = false;

[[noreturn]] void note_lack_of_memory() {
    has_run_out_of_memory = true;
    throw std::bad_alloc();
}

Error unreadable(const std::string& path, const std::string& reason) {
    if (has_run_out_of_memory || reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    return {path + ": cannot be read as a model (" + one_line(reason) + "). Repair the file or export it again."};
}

/// Where the file does not say, the value stays.
template <class T>
void take(const aiScene& scene, const char* name, T& value) {
    if (scene.mMetaData == nullptr) return;
    T found{};
    float short_one = 0;
    if (scene.mMetaData->Get(name, found))
        value = found;
    else if (scene.mMetaData->Get(name, short_one))
        value = static_cast<T>(short_one);
}

std::string counted(uint64_t n, const char* one, const char* many, const char* what) {
    return std::to_string(n) + " " + (n == 1 ? one : many) + " " + what;
}

/// What assimp passes over without a word, told from the names that stand in the file, text or binary.
std::vector<std::string> notes_of_fbx(std::string_view bytes) {
    std::vector<std::string> notes;
    if (bytes.find("UnitScaleFactor") == bytes.npos)
        notes.push_back("It names no unit; its numbers were taken for centimetres.");
    for (const std::string_view curved : {"NurbsSurface", "NurbsCurve", "\"Patch\""})
        if (bytes.find(curved) != bytes.npos) {
            notes.push_back("Its curves and curved surfaces were left out.");
            break;
        }
    return notes;
}

std::vector<std::string> notes_of_obj(std::string_view bytes) {
    uint64_t curves = 0;
    Words words(bytes);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        curves += word == "surf" || word == "curv";
        words.skip_line();
    }
    if (curves == 0) return {};
    return {counted(curves, "curve or curved surface was", "curves or curved surfaces were", "left out.")};
}

Affine place_of_fbx(const aiScene& scene, std::vector<std::string>& notes) {
    FbxAxes axes;
    take(scene, "UpAxis", axes.up);
    take(scene, "UpAxisSign", axes.up_sign);
    take(scene, "FrontAxis", axes.front);
    take(scene, "FrontAxisSign", axes.front_sign);
    take(scene, "CoordAxis", axes.coord);
    take(scene, "CoordAxisSign", axes.coord_sign);
    take(scene, "UnitScaleFactor", axes.unit);
    return place_of(axes, notes);
}

/// What moves or bends the meshes and is left out. Of looks (pictures, colours, lights) nothing is said.
void note_motion(const aiScene& scene, std::vector<std::string>& notes) {
    uint64_t skins = 0, shapes = 0;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        skins += scene.mMeshes[m]->mNumBones > 0;
        shapes += scene.mMeshes[m]->mNumAnimMeshes > 0;
    }
    const uint64_t animations = scene.mNumAnimations;
    if (skins > 0)
        notes.push_back(counted(skins, "mesh with bones stands", "meshes with bones stand", "as modelled, not posed."));
    if (shapes > 0)
        notes.push_back(counted(shapes, "mesh with morph targets has", "meshes with morph targets have",
                                "the shape without them."));
    if (animations > 0)
        notes.push_back(
            counted(animations, "animation was left out.", "animations were left out.", "Nodes stand at rest."));
}

/// The file's coordinates in ours, and sentences on them.
using Place = std::function<Affine(const aiScene&, std::vector<std::string>& notes)>;

Affine as_it_stands(const aiScene&, std::vector<std::string>&) {
    return {};
}

/// The importer is never torn down: assimp 5.2 frees some of what it has read twice, and the process that reads ends
/// when it has handed over the result. `files` goes to the importer, which asks it for `name` where the model has
/// another.
Result<Corners> read_by_assimp(std::unique_ptr<FolderFiles> files, const std::string& path, const Place& place,
                               const std::string& name = "") {
    Assimp::Importer& importer = *new Assimp::Importer;
    importer.SetIOHandler(files.release());
    const aiScene* scene = importer.ReadFile(name.empty() ? path : name, 0);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    if (auto r = check_indices(*scene, path); !r) return Error{r.error()};
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    std::vector<std::string> notes;
    const Affine root = place(*scene, notes);
    auto corners = gather(*scene, path, root);
    if (!corners) return corners;
    note_motion(*scene, notes);
    corners->notes.insert(corners->notes.end(), notes.begin(), notes.end());
    return corners;
}

Result<Corners> with_notes(Result<Corners> corners, const std::vector<std::string>& notes) {
    if (corners) corners->notes.insert(corners->notes.begin(), notes.begin(), notes.end());
    return corners;
}

Result<std::string> bytes_of(FolderFiles& files, const std::string& path) {
    const std::unique_ptr<Assimp::IOStream> stream(files.open_as_it_is(path));
    if (stream == nullptr) return unreadable(path, "it cannot be opened");
    return FolderFiles::whole(*stream);
}

/// For formats that assimp reads wrongly and that are read here, from their bytes to their triangles.
Result<Corners> read_by(Result<Corners> (*reader)(std::string bytes, const std::string& path),
                        const std::string& path) {
    FolderFiles files(path);
    auto bytes = bytes_of(files, path);
    if (!bytes) return Error{bytes.error()};
    return reader(std::move(*bytes), path);
}

/// `bytes` are those of the model, or of one inside it.
Result<Corners> read_collada(const std::string& path, std::string bytes) {
    auto plain = plain_collada(std::move(bytes), path);
    if (!plain) return Error{plain.error()};
    auto files = std::make_unique<FolderFiles>(path);
    const std::string name = path + ".dae";  // whatever it is called: assimp goes by the last part
    files->replace_model(std::move(plain->text), name);
    return with_notes(read_by_assimp(std::move(files), path, as_it_stands, name), plain->notes);
}

Result<Corners> read_collada(const std::string& path) {
    FolderFiles files(path);
    auto bytes = bytes_of(files, path);
    if (!bytes) return Error{bytes.error()};
    return read_collada(path, std::move(*bytes));
}

/// Collada in a ZIP.
Result<Corners> read_packed_collada(const std::string& path) {
    const ZipFile zip(ModelFolder(path).find(path));
    if (!zip.is_open()) return unreadable(path, "it is no ZIP file, or cut off");
    const auto is_model = [](const std::string& name) {
        return is_word(std::filesystem::path(name).extension().string(), ".dae");
    };
    const auto model = std::find_if(zip.names().begin(), zip.names().end(), is_model);
    auto bytes = model == zip.names().end() ? std::nullopt : zip.read(*model);
    if (!bytes) return unreadable(path, "no Collada file is in it, or it is damaged");
    auto corners = read_collada(path, std::move(*bytes));
    const auto models = std::count_if(zip.names().begin(), zip.names().end(), is_model);
    if (corners && models > 1)
        corners->notes.push_back("Of " + std::to_string(models) + " models in it the first was read.");
    return corners;
}

/// The file as it is; `look` gives notes.
template <class Look>
Result<Corners> read_with_notes(const std::string& path, const Place& place, const Look& look) {
    auto files = std::make_unique<FolderFiles>(path);
    auto bytes = bytes_of(*files, path);
    if (!bytes) return Error{bytes.error()};
    const std::vector<std::string> notes = look(plain_text(std::move(*bytes)));
    return with_notes(read_by_assimp(std::move(files), path, place), notes);
}

/// AMF and X3D say how long their unit is; assimp does not look.
Result<Corners> read_in_its_unit(const std::string& path) {
    auto files = std::make_unique<FolderFiles>(path);
    auto bytes = bytes_of(*files, path);
    if (!bytes) return Error{bytes.error()};
    const auto unit = unit_of_xml(plain_text(std::move(*bytes)), path);
    if (!unit) return Error{unit.error()};
    const Affine root = scaled(*unit);
    return read_by_assimp(std::move(files), path, [root](const aiScene&, std::vector<std::string>&) { return root; });
}

Result<Corners> read_gltf(const std::string& path) {
    try {
        const gltf::Document document(gltf::bytes_of_model(path), path);
        if (!document.is_version_1()) return gltf::read_document(document);
    } catch (const gltf::Refusal& refusal) {
        return gltf::error_of(refusal, path);
    }
    auto corners = read_by_assimp(std::make_unique<FolderFiles>(path), path, as_it_stands);
    if (corners) corners->notes.push_back("Read as glTF 1, without skins and extensions: 2.0 is read better.");
    return corners;
}

Result<Corners> read_corners(const std::string& path) {
    if (gltf::is_gltf(path)) return read_gltf(path);
    const std::string extension = small_letters(std::filesystem::path(path).extension().string());
    if (extension == ".stl") return read_by(read_stl, path);
    if (extension == ".ply") return read_by(read_ply, path);
    if (extension == ".3mf") {
        const std::string file = ModelFolder(path).find(path);
        return file.empty() ? unreadable(path, "it cannot be opened") : read_3mf(file, path);
    }
    if (extension == ".dae") return read_collada(path);
    if (extension == ".zae") return read_packed_collada(path);
    if (extension == ".fbx") return read_with_notes(path, place_of_fbx, notes_of_fbx);
    if (extension == ".obj") return read_with_notes(path, as_it_stands, notes_of_obj);
    if (extension == ".amf" || extension == ".x3d") return read_in_its_unit(path);
    return read_by_assimp(std::make_unique<FolderFiles>(path), path, as_it_stands);
}

}  // namespace

Result<ConvertedModel> convert_model(const std::string& path) {
    std::set_new_handler(note_lack_of_memory);
    auto corners = read_corners(path);
    if (!corners) return Error{corners.error()};
    return joined_model(std::move(*corners), path);
}

}  // namespace cullet
