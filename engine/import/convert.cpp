#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <filesystem>
#include <new>
#include <tuple>

#include "engine/import/folder_files.hpp"
#include "engine/import/import.hpp"
#include "engine/math.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

/// x -> linear x + move, in double, so that a deep tree of nodes costs no digits.
struct Affine {
    Vec3d row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3d move;
};

Vec3d turned(const Affine& a, Vec3d v) {
    return {dot(a.row[0], v), dot(a.row[1], v), dot(a.row[2], v)};
}

/// Normals turn with the cofactor matrix det(A) A^-T, which exists for singular A too. Its sign follows the
/// determinant, so that normals stay on the outside of a mirrored surface once the winding is turned.
Vec3d turned_normal(const Affine& a, Vec3d n) {
    return {dot(cross(a.row[1], a.row[2]), n), dot(cross(a.row[2], a.row[0]), n), dot(cross(a.row[0], a.row[1]), n)};
}

double determinant(const Affine& a) {
    return dot(a.row[0], cross(a.row[1], a.row[2]));
}

Affine child_of(const Affine& parent, const aiMatrix4x4& m) {
    const Vec3d columns[4] = {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
    Affine child;
    const Vec3d x = turned(parent, columns[0]), y = turned(parent, columns[1]), z = turned(parent, columns[2]);
    child.row[0] = {x.x, y.x, z.x};
    child.row[1] = {x.y, y.y, z.y};
    child.row[2] = {x.z, y.z, z.z};
    child.move = turned(parent, columns[3]) + parent.move;
    return child;
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

/// Three entries a triangle, before equal points are joined.
struct Corners {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<uint16_t> materials;  // one a triangle
    bool has_normals = false, has_uvs = false;
    uint64_t collapsed = 0;  // triangles left out
    uint64_t left_out = 0;   // lines and points
    uint64_t unusable_normals = 0, unusable_uvs = 0;
    uint64_t points = 0;  // of the file, that triangles use, once for each place of their mesh
};

Vec3 vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

/// False for one that is zero or not finite.
bool is_usable_normal(Vec3 unit) {
    const float squared = dot(unit, unit);
    return squared > 0.99f && squared < 1.01f;
}

bool is_usable_uv(Vec2 uv) {
    return std::fabs(uv.x) <= kLargestCoordinate && std::fabs(uv.y) <= kLargestCoordinate;
}

bool has_repeated_corner(const Vec3* p) {
    return p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
}

/// False for a triangle that is left out: a vertex that only such triangles used must not stay behind.
bool append_triangle(Corners& out, const aiMesh& mesh, const aiFace& face, const Affine& place) {
    out.has_normals = out.has_normals || mesh.HasNormals();
    out.has_uvs = out.has_uvs || mesh.HasTextureCoords(0);
    const bool is_mirrored = determinant(place) < 0;
    const unsigned order[3] = {face.mIndices[0], face.mIndices[is_mirrored ? 2 : 1],
                               face.mIndices[is_mirrored ? 1 : 2]};
    Vec3d corner[3];
    Vec3 rounded[3];
    for (int c = 0; c < 3; ++c) {
        corner[c] = turned(place, Vec3d(vector_of(mesh.mVertices[order[c]]))) + place.move;
        rounded[c] = corner[c].to_float() + Vec3{};  // adding zero makes -0 into 0, so that joining can compare bits
    }
    if (has_repeated_corner(rounded)) return false;
    const Vec3d face_normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double side = is_mirrored ? -1 : 1;
    for (int c = 0; c < 3; ++c) {
        out.positions.push_back(rounded[c]);
        Vec3 normal;
        if (mesh.HasNormals())
            normal = normalised(side * turned_normal(place, Vec3d(vector_of(mesh.mNormals[order[c]])))).to_float();
        if (!is_usable_normal(normal)) {
            out.unusable_normals += mesh.HasNormals();
            normal = normalised(face_normal).to_float();
        }
        out.normals.push_back(normal);
        Vec2 uv;
        if (mesh.HasTextureCoords(0)) uv = {mesh.mTextureCoords[0][order[c]].x, mesh.mTextureCoords[0][order[c]].y};
        if (!is_usable_uv(uv)) uv = {}, ++out.unusable_uvs;
        out.uvs.push_back(uv);
    }
    out.materials.push_back(static_cast<uint16_t>(mesh.mMaterialIndex));
    return true;
}

/// One mesh at one of its places.
void append_mesh(Corners& out, const aiMesh& mesh, const Affine& place) {
    std::vector<bool> is_used(mesh.mNumVertices);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        out.left_out += face.mNumIndices == 1 || face.mNumIndices == 2;
        if (face.mNumIndices != 3) continue;
        if (!append_triangle(out, mesh, face, place)) {
            ++out.collapsed;
            continue;
        }
        for (unsigned c = 0; c < 3; ++c) {
            out.points += !is_used[face.mIndices[c]];
            is_used[face.mIndices[c]] = true;
        }
    }
}

Result<Corners> gather(const aiScene& scene, const std::string& path) {
    Corners corners;
    struct Item {
        const aiNode* node;
        Affine parent;
    };
    std::vector<Item> stack;
    if (scene.mRootNode != nullptr) stack.push_back({scene.mRootNode, {}});
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

/// For each corner its vertex: corners share one when all three coordinates are equal. Vertices are numbered as corners
/// first name them, so the order of the file is kept.
std::vector<uint32_t> join_equal_points(const std::vector<Vec3>& points, std::vector<Vec3>& vertices) {
    const auto key = [&points](uint32_t c) {
        return std::tuple(std::bit_cast<uint32_t>(points[c].x), std::bit_cast<uint32_t>(points[c].y),
                          std::bit_cast<uint32_t>(points[c].z), c);
    };
    std::vector<uint32_t> order(points.size()), first(points.size()), vertex(points.size());
    for (uint32_t c = 0; c < order.size(); ++c) order[c] = c;
    std::sort(order.begin(), order.end(), [&key](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        const Vec3 p = points[order[i]], q = points[order[i > 0 ? i - 1 : 0]];
        const bool is_new = i == 0 || std::bit_cast<uint32_t>(p.x) != std::bit_cast<uint32_t>(q.x) ||
                            std::bit_cast<uint32_t>(p.y) != std::bit_cast<uint32_t>(q.y) ||
                            std::bit_cast<uint32_t>(p.z) != std::bit_cast<uint32_t>(q.z);
        first[order[i]] = is_new ? order[i] : first[order[i - 1]];
    }
    for (uint32_t c = 0; c < points.size(); ++c) {
        if (first[c] == c) {
            vertex[c] = static_cast<uint32_t>(vertices.size());
            vertices.push_back(points[c]);
        } else {
            vertex[c] = vertex[first[c]];  // first[c] < c
        }
    }
    return vertex;
}

std::string name_of(const std::string& path) {
    std::string name = one_line(std::filesystem::path(path).stem().string());
    return name.substr(0, kLongestMeshName);
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

}  // namespace

Result<ConvertedModel> convert_model(const std::string& path) {
    std::set_new_handler(note_lack_of_memory);
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderFiles(path));  // the importer deletes it
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    if (auto r = check_indices(*scene, path); !r) return Error{r.error()};
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) return unreadable(path, importer.GetErrorString());
    auto corners = gather(*scene, path);
    if (!corners) return Error{corners.error()};

    ConvertedModel model;
    Mesh& mesh = model.mesh;
    const std::vector<uint32_t> vertex = join_equal_points(corners->positions, mesh.positions);
    model.collapsed = corners->collapsed;
    model.left_out = corners->left_out;
    model.unusable_normals = corners->unusable_normals;
    model.unusable_uvs = corners->unusable_uvs;
    model.joined = corners->points - mesh.positions.size();
    mesh.name = name_of(path);
    for (size_t c = 0; c < vertex.size(); c += 3) mesh.triangles.push_back({vertex[c], vertex[c + 1], vertex[c + 2]});
    if (corners->has_normals) mesh.corner_normals = std::move(corners->normals);
    if (corners->has_uvs) mesh.corner_uvs = std::move(corners->uvs);
    mesh.materials = std::move(corners->materials);
    return model;
}

}  // namespace cullet
