#include "engine/import/assimp_scene.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <new>
#include <span>
#include <utility>

#include "engine/import/assimp_bones.hpp"
#include "engine/import/fbx_place.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

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

/// Nor would it look at what hangs on bones.
Result<void> check_bones(const aiScene& scene, const std::string& path) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        for (unsigned b = 0; b < mesh.mNumBones; ++b)
            for (unsigned w = 0; w < mesh.mBones[b]->mNumWeights; ++w)
                if (mesh.mBones[b]->mWeights[w].mVertexId >= mesh.mNumVertices)
                    return Error{path + ": bone " + std::to_string(b) + " of " + mesh_title(scene, m) +
                                 " moves vertex " + std::to_string(mesh.mBones[b]->mWeights[w].mVertexId) +
                                 ", but there are " + std::to_string(mesh.mNumVertices) +
                                 ". Repair the file or export it again."};
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

/// The meshes of a scene at their places.
class Gatherer {
 public:
    Gatherer(const aiScene& scene, const std::string& path, const Affine& root)
        : scene_(scene), path_(path), places_(scene, root) {}

    Result<Corners> gather() {
        for (const PlacedNode& placed : places_.nodes())
            for (unsigned i = 0; i < placed.node->mNumMeshes; ++i)
                if (auto r = append(placed.node->mMeshes[i], placed.place); !r) return Error{r.error()};
        add_notes();
        return std::move(out_);
    }

 private:
    Result<void> append(unsigned m, const Affine& place) {
        if (m >= scene_.mNumMeshes)
            return Error{path_ + ": a node names mesh " + std::to_string(m) + ", but there are " +
                         std::to_string(scene_.mNumMeshes) + ". Repair the file or export it again."};
        const aiMesh& mesh = *scene_.mMeshes[m];
        if (mesh.mMaterialIndex > 65535)
            return Error{path_ + ": " + mesh_title(scene_, m) + " has material " + std::to_string(mesh.mMaterialIndex) +
                         ", above 65535. Merge some materials."};
        append_mesh(mesh, BonePose(mesh, places_, place));
        return check_triangles(out_, path_);
    }

    void append_mesh(const aiMesh& mesh, const BonePose& pose) {
        points_without_bone_ += pose.points_without_bone();
        skins_without_nodes_ += pose.lacks_nodes();
        UsedPoints used(mesh.mNumVertices);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            out_.left_out += face.mNumIndices == 1 || face.mNumIndices == 2;
            if (face.mNumIndices != 3 || !append_face(mesh, face, pose)) continue;
            used.add(out_, std::span(face.mIndices, 3));
        }
    }

    bool append_face(const aiMesh& mesh, const aiFace& face, const BonePose& pose) {
        const SourceTriangle triangle = triangle_of(mesh, face);
        if (const Affine* place = pose.common()) return append_triangle(out_, triangle, *place);
        const auto place = [&](unsigned c) { return pose.place_of(face.mIndices[c]); };
        return append_posed_triangle(out_, triangle, {place(0), place(1), place(2)});
    }

    /// What moves or bends the meshes and is left out. Of looks (pictures, colours, lights) nothing is said.
    void add_notes() {
        uint64_t shapes = 0, uvs = 0;
        for (unsigned m = 0; m < scene_.mNumMeshes; ++m) {
            shapes += scene_.mMeshes[m]->mNumAnimMeshes > 0;
            uvs = std::max<uint64_t>(uvs, scene_.mMeshes[m]->GetNumUVChannels());
        }
        const auto say = [this](uint64_t n, const char* one, const char* many) {
            if (n > 0) out_.notes.push_back(counted(n, one, many));
        };
        say(skins_without_nodes_, "mesh with bones stands as modelled: not all of its bones are nodes.",
            "meshes with bones stand as modelled: not all of their bones are nodes.");
        say(points_without_bone_, "point of a skin hangs on no bone and stands as modelled.",
            "points of skins hang on no bone and stand as modelled.");
        say(shapes, "mesh with morph targets has the shape without them.",
            "meshes with morph targets have the shape without them.");
        say(scene_.mNumAnimations, "animation was left out. Nodes stand at rest.",
            "animations were left out. Nodes stand at rest.");
        say(uvs > 1 ? uvs - 1 : 0, "further set of texture coordinates was left out.",
            "further sets of texture coordinates were left out.");
    }

    const aiScene& scene_;
    const std::string& path_;
    Places places_;
    Corners out_;
    uint64_t points_without_bone_ = 0, skins_without_nodes_ = 0;
};

// Assimp catches what a failed allocation throws and says anything from "std::bad_alloc" to "Unknown exception", by
// where it failed. So the program notes it; nobody but its child, which reads one file and ends, asks for it.
bool has_run_out_of_memory = false;

[[noreturn]] void note_lack_of_memory() {
    has_run_out_of_memory = true;
    throw std::bad_alloc();
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

}  // namespace

void watch_memory() {
    std::set_new_handler(note_lack_of_memory);
}

Error unreadable(const std::string& path, const std::string& reason) {
    if (has_run_out_of_memory || reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    return {path + ": cannot be read as a model (" + one_line(reason) + "). Repair the file or export it again."};
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

Result<Corners> read_by_assimp(std::unique_ptr<FolderFiles> files, const std::string& path, const Place& place,
                               const std::string& name) {
    Assimp::Importer& importer = *new Assimp::Importer;
    importer.SetIOHandler(files.release());
    const aiScene* scene = importer.ReadFile(name.empty() ? path : name, 0);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    if (auto r = check_indices(*scene, path); !r) return Error{r.error()};
    if (auto r = check_bones(*scene, path); !r) return Error{r.error()};
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    std::vector<std::string> notes;
    const Affine root = place(*scene, notes);
    auto corners = Gatherer(*scene, path, root).gather();
    if (!corners) return corners;
    corners->notes.insert(corners->notes.begin(), notes.begin(), notes.end());
    return corners;
}

}  // namespace cullet
