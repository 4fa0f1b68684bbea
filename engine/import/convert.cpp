#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "engine/import/assimp_scene.hpp"
#include "engine/import/collada.hpp"
#include "engine/import/corners.hpp"
#include "engine/import/folder_files.hpp"
#include "engine/import/gltf/read_gltf.hpp"
#include "engine/import/import.hpp"
#include "engine/import/obj.hpp"
#include "engine/import/passed_over.hpp"
#include "engine/import/ply.hpp"
#include "engine/import/stl.hpp"
#include "engine/import/text_encoding.hpp"
#include "engine/import/three_mf.hpp"
#include "engine/import/words.hpp"
#include "engine/import/xml_unit.hpp"
#include "engine/import/zip.hpp"

namespace cullet {
namespace {

Affine as_it_stands(const aiScene&, std::vector<std::string>&) {
    return {};
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

struct Packed {
    std::string bytes;
    std::vector<std::string> notes;
};

/// The first model of that extension in a ZIP.
Result<Packed> unpacked(const std::string& path, const char* extension) {
    const ZipFile zip(ModelFolder(path).find(path));
    if (!zip.is_open()) return unreadable(path, "it is no ZIP file, or cut off");
    const auto is_model = [extension](const std::string& name) {
        return is_word(std::filesystem::path(name).extension().string(), extension);
    };
    const auto model = std::find_if(zip.names().begin(), zip.names().end(), is_model);
    auto bytes = model == zip.names().end() ? std::nullopt : zip.read(*model);
    if (!bytes) return unreadable(path, std::string("no ") + extension + " file is in it, or it is damaged");
    Packed packed{std::move(*bytes), {}};
    const auto models = std::count_if(zip.names().begin(), zip.names().end(), is_model);
    if (models > 1) packed.notes.push_back("Of " + std::to_string(models) + " models in it the first was read.");
    return packed;
}

Result<Corners> read_packed_collada(const std::string& path) {
    auto packed = unpacked(path, ".dae");
    if (!packed) return Error{packed.error()};
    return with_notes(read_collada(path, std::move(packed->bytes)), packed->notes);
}

Result<Corners> read_fbx(const std::string& path) {
    auto files = std::make_unique<FolderFiles>(path);
    auto bytes = bytes_of(*files, path);
    if (!bytes) return Error{bytes.error()};
    const std::vector<std::string> notes = notes_of_fbx(plain_text(std::move(*bytes)));
    return with_notes(read_by_assimp(std::move(files), path, place_of_fbx), notes);
}

/// AMF and X3D. An AMF may be packed in a ZIP.
Result<Corners> read_in_its_unit(const std::string& path) {
    auto files = std::make_unique<FolderFiles>(path);
    auto bytes = bytes_of(*files, path);
    if (!bytes) return Error{bytes.error()};
    std::vector<std::string> notes;
    if (bytes->rfind("PK", 0) == 0) {
        auto packed = unpacked(path, ".amf");
        if (!packed) return Error{packed.error()};
        *bytes = std::move(packed->bytes);
        notes = packed->notes;
    }
    std::string text = plain_xml(std::move(*bytes));
    const auto places = places_of_xml(text, path);
    if (!places) return Error{places.error()};
    if (places->turned > 0)
        notes.push_back(counted(places->turned, "instance of a constellation is", "instances of constellations are") +
                        " turned in the file; here all stand unturned.");
    files->replace_model(std::move(text), path);
    const Affine root = scaled(places->metres);
    return with_notes(
        read_by_assimp(std::move(files), path, [root](const aiScene&, std::vector<std::string>&) { return root; }),
        notes);
}

Result<Corners> read_obj_with_materials(const std::string& path) {
    FolderFiles files(path);
    auto bytes = bytes_of(files, path);
    if (!bytes) return Error{bytes.error()};
    return read_obj(std::move(*bytes), path, [&](const std::string& name) -> std::optional<std::string> {
        const std::string beside = path.substr(0, path.rfind('/') + 1) + name;
        const std::unique_ptr<Assimp::IOStream> stream(files.open_as_it_is(beside));
        if (stream == nullptr) return std::nullopt;
        return FolderFiles::whole(*stream);
    });
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

/// Of formats for what fills a space. Some of these files hold a surface as well; none is read.
bool is_of_volumes(const std::string& extension) {
    constexpr std::string_view kOfVolumes[] = {".vtk", ".vtu", ".node", ".ele"};
    return std::find(std::begin(kOfVolumes), std::end(kOfVolumes), extension) != std::end(kOfVolumes);
}

Result<Corners> read_corners(const std::string& path) {
    if (gltf::is_gltf(path)) return read_gltf(path);
    const std::string extension = small_letters(std::filesystem::path(path).extension().string());
    if (is_of_volumes(extension))
        return Error{path + ": " + extension +
                     " files are for tetrahedra and other volumes, which are no surface. Export the surface as PLY, "
                     "STL or OBJ."};
    if (extension == ".stl") return read_by(read_stl, path);
    if (extension == ".ply") return read_by(read_ply, path);
    if (extension == ".3mf") {
        const std::string file = ModelFolder(path).find(path);
        return file.empty() ? unreadable(path, "it cannot be opened") : read_3mf(file, path);
    }
    if (extension == ".dae") return read_collada(path);
    if (extension == ".zae") return read_packed_collada(path);
    if (extension == ".fbx") return read_fbx(path);
    if (extension == ".obj") return read_obj_with_materials(path);
    if (extension == ".amf" || extension == ".x3d") return read_in_its_unit(path);
    return read_by_assimp(std::make_unique<FolderFiles>(path), path, as_it_stands);
}

}  // namespace

Result<ConvertedModel> convert_model(const std::string& path) {
    watch_memory();
    auto corners = read_corners(path);
    if (!corners) return Error{corners.error()};
    return joined_model(std::move(*corners), path);
}

}  // namespace cullet
