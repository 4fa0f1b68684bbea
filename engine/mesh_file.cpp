#include "engine/mesh_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

namespace cullet {
namespace {

static_assert(std::endian::native == std::endian::little, "mesh files are little-endian and are copied as they stand");
static_assert(sizeof(Vec3) == 12 && sizeof(Vec2) == 8 && sizeof(std::array<uint32_t, 3>) == 12);

constexpr char kMagic[8] = {'c', 'm', 'e', 's', 'h', '\r', '\n', '\x1a'};
constexpr uint32_t kVersion = 1;
enum : uint32_t { kHasNormals = 1, kHasUvs = 2, kHasMaterials = 4, kAllFlags = 7 };
constexpr uint64_t kChunkHeader = 16;  // bytes
constexpr uint64_t kLargestFile = 1ull << 36;
constexpr size_t kLongestPath = 4096;  // bytes; a sentence names the whole of it

struct Header {
    char magic[8];
    uint32_t version;
    uint32_t flags;
    uint64_t vertices;
    uint64_t triangles;
    uint64_t name_bytes;
    uint64_t payload_bytes;
    uint64_t payload_hash;
    uint64_t header_hash;  // of everything above
};
static_assert(sizeof(Header) == 64);

// A fuzzer cannot guess checksums, and what stands behind them is to be looked at too.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kChecksumsCount = false;
#else
constexpr bool kChecksumsCount = true;
#endif

std::string text(uint64_t n) {
    return std::to_string(n);
}

std::string text(float x) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", static_cast<double>(x));
    return buffer;
}

/// A path as sentences name it: in one line.
std::string quoted(const std::string& path) {
    return one_line(path, kLongestPath);
}

Error damaged(const std::string& name, const std::string& what) {
    return {name + ": " + what + ". The mesh file is damaged; import the model again."};
}

bool is_coordinate(float x) {
    return std::fabs(x) <= kLargestCoordinate;
}  // false for NaN

Result<void> validate_name(const Mesh& mesh, const std::string& name) {
    if (mesh.name.size() > kLongestMeshName)
        return Error{name + ": the mesh's name has " + text(mesh.name.size()) + " bytes, more than " +
                     text(kLongestMeshName) + ". Shorten it."};
    for (size_t i = 0; i < mesh.name.size(); ++i)
        if (static_cast<unsigned char>(mesh.name[i]) < 32 || mesh.name[i] == 127)
            return Error{name + ": byte " + text(i) + " of the mesh's name is the control character " +
                         text(static_cast<uint64_t>(static_cast<unsigned char>(mesh.name[i]))) + ". Rename the mesh."};
    return {};
}

Result<void> validate_counts(const Mesh& mesh, const std::string& name) {
    const size_t triangles = mesh.triangles.size();
    if (triangles == 0) return Error{name + ": holds no triangle. Export the model with faces."};
    if (triangles > kMostMeshRows || mesh.positions.size() > kMostMeshRows)
        return Error{name + ": has " + text(mesh.positions.size()) + " vertices and " + text(triangles) +
                     " triangles, more than " + text(kMostMeshRows) + ". Split the model."};
    const auto fits = [](size_t size, size_t wanted) { return size == 0 || size == wanted; };
    if (!fits(mesh.corner_normals.size(), 3 * triangles) || !fits(mesh.corner_uvs.size(), 3 * triangles) ||
        !fits(mesh.materials.size(), triangles))
        return Error{name + ": has " + text(triangles) + " triangles, but " + text(mesh.corner_normals.size()) +
                     " corner normals, " + text(mesh.corner_uvs.size()) + " corner texture coordinates and " +
                     text(mesh.materials.size()) + " material ids. Give three, three and one a triangle, or none."};
    return {};
}

Result<void> validate_positions(const Mesh& mesh, const std::string& name) {
    Vec3 low{kLargestCoordinate, kLargestCoordinate, kLargestCoordinate};
    Vec3 high{-kLargestCoordinate, -kLargestCoordinate, -kLargestCoordinate};
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        if (!is_coordinate(p.x) || !is_coordinate(p.y) || !is_coordinate(p.z))
            return Error{
                name + ": vertex " + text(v) + " stands at (" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) +
                "), " +
                (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)
                     ? "not within " + text(kLargestCoordinate) + " m of the origin. Repair or scale the model."
                     : "which is no place. Repair the model.")};
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    const float extent = std::fmax(high.x - low.x, std::fmax(high.y - low.y, high.z - low.z));
    if (!(extent >= kSmallestMeshExtent))
        return Error{name + ": its longest side is " + text(extent) + " m, below " + text(kSmallestMeshExtent) +
                     " m. Scale the model to metres."};
    return {};
}

Result<void> validate_corners(const Mesh& mesh, const std::string& name) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const uint32_t v : mesh.triangles[t])
            if (v >= mesh.positions.size())
                return Error{name + ": triangle " + text(t) + " names vertex " + text(uint64_t{v}) +
                             ", but there are " + text(mesh.positions.size()) + ". Export the model again."};
    for (size_t c = 0; c < mesh.corner_normals.size(); ++c) {
        const Vec3 n = mesh.corner_normals[c];
        const float squared = n.x * n.x + n.y * n.y + n.z * n.z;
        if (squared != 0 && !(squared > 0.98f && squared < 1.02f))
            return Error{name + ": the normal at corner " + text(c % 3) + " of triangle " + text(c / 3) + " is (" +
                         text(n.x) + ", " + text(n.y) + ", " + text(n.z) + "), not of length 1 or 0. Normalise it."};
    }
    for (size_t c = 0; c < mesh.corner_uvs.size(); ++c)
        if (!is_coordinate(mesh.corner_uvs[c].x) || !is_coordinate(mesh.corner_uvs[c].y))
            return Error{name + ": the texture coordinate at corner " + text(c % 3) + " of triangle " + text(c / 3) +
                         " is (" + text(mesh.corner_uvs[c].x) + ", " + text(mesh.corner_uvs[c].y) + "), not within " +
                         text(kLargestCoordinate) + ". Repair the model's texture coordinates."};
    return {};
}

/// Takes chunks off the front of the payload.
struct ChunkReader {
    std::span<const uint8_t> bytes;
    const std::string& name;
    uint64_t offset = sizeof(Header);  // in the file, for sentences

    template <class T>
    Result<void> take(const char* tag, uint64_t count, std::vector<T>& out) {
        const uint64_t wanted = count * sizeof(T);
        char found[4];
        uint32_t zero = 0;
        uint64_t size = 0;
        if (bytes.size() < kChunkHeader)
            return damaged(name, std::string("chunk ") + tag + " is missing at byte " + text(offset));
        std::memcpy(found, bytes.data(), 4);
        std::memcpy(&zero, bytes.data() + 4, 4);
        std::memcpy(&size, bytes.data() + 8, 8);
        if (std::memcmp(found, tag, 4) != 0 || zero != 0)
            return damaged(name, std::string("no chunk ") + tag + " at byte " + text(offset));
        if (size != wanted || wanted > bytes.size() - kChunkHeader)
            return damaged(name, std::string("chunk ") + tag + " at byte " + text(offset) + " states " + text(size) +
                                     " bytes, needs " + text(wanted) + " and has " + text(bytes.size() - kChunkHeader));
        out.resize(count);
        if (wanted > 0) std::memcpy(out.data(), bytes.data() + kChunkHeader, wanted);
        bytes = bytes.subspan(kChunkHeader + wanted);
        offset += kChunkHeader + wanted;
        return {};
    }
};

struct Chunk {
    const char* tag;
    const void* data;
    uint64_t size;
};

template <class T>
Chunk chunk(const char* tag, const T& container) {
    return {tag, container.data(), container.size() * sizeof(container[0])};
}

uint8_t* put_chunk(uint8_t* to, const Chunk& chunk) {
    std::memcpy(to, chunk.tag, 4);
    std::memset(to + 4, 0, 4);
    std::memcpy(to + 8, &chunk.size, 8);
    if (chunk.size > 0) std::memcpy(to + kChunkHeader, chunk.data, chunk.size);
    return to + kChunkHeader + chunk.size;
}

/// The header against itself and against the bytes that follow it. The sums below cannot overflow once each count is at
/// most the number of bytes there.
Result<Header> parse_header(std::span<const uint8_t> bytes, const std::string& name) {
    Header header;
    if (!is_mesh_file(bytes))
        return Error{name +
                     ": is no mesh file (its first bytes are not those of a .cmesh). Import it with cullet_import."};
    if (bytes.size() < sizeof header)
        return damaged(name, "ends inside the header, after " + text(bytes.size()) + " of 64 bytes");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.version != kVersion)
        return Error{name + ": has version " + text(uint64_t{header.version}) + ", this build reads version " +
                     text(uint64_t{kVersion}) + ". Import the model again."};
    if (kChecksumsCount && XXH3_64bits(bytes.data(), offsetof(Header, header_hash)) != header.header_hash)
        return damaged(name, "the header's checksum does not fit");
    const uint64_t present = bytes.size() - sizeof header;
    if (header.payload_bytes != present)
        return damaged(
            name, "the header states " + text(header.payload_bytes) + " bytes after it, there are " + text(present));
    if ((header.flags & ~kAllFlags) != 0)
        return damaged(name, "the header names unknown chunks, bits " + text(uint64_t{header.flags}));
    if (header.vertices > kMostMeshRows || header.triangles > kMostMeshRows || header.name_bytes > kLongestMeshName)
        return damaged(name, "the header states " + text(header.vertices) + " vertices, " + text(header.triangles) +
                                 " triangles and a name of " + text(header.name_bytes) +
                                 " bytes, above the limits of " + text(kMostMeshRows) + " and " +
                                 text(kLongestMeshName));
    const uint64_t per_triangle = 12u + (header.flags & kHasNormals ? 36u : 0u) + (header.flags & kHasUvs ? 24u : 0u) +
                                  (header.flags & kHasMaterials ? 2u : 0u);
    const uint64_t chunks = 3u + static_cast<uint64_t>(std::popcount(header.flags));
    const uint64_t needed =
        chunks * kChunkHeader + header.name_bytes + 12 * header.vertices + per_triangle * header.triangles;
    if (needed != present)
        return damaged(name, text(header.vertices) + " vertices and " + text(header.triangles) + " triangles need " +
                                 text(needed) + " bytes, there are " + text(present));
    if (kChecksumsCount && XXH3_64bits(bytes.data() + sizeof header, present) != header.payload_hash)
        return damaged(name, "the checksum of the data does not fit");
    return header;
}

Result<Mesh> parse_payload(const Header& header, std::span<const uint8_t> payload, const std::string& name) {
    Mesh mesh;
    std::vector<char> mesh_name;
    ChunkReader reader{payload, name};
    const uint64_t triangles = header.triangles;
    if (auto r = reader.take("NAME", header.name_bytes, mesh_name); !r) return Error{r.error()};
    if (auto r = reader.take("POSI", header.vertices, mesh.positions); !r) return Error{r.error()};
    if (auto r = reader.take("TRIA", triangles, mesh.triangles); !r) return Error{r.error()};
    if (header.flags & kHasNormals)
        if (auto r = reader.take("NORM", 3 * triangles, mesh.corner_normals); !r) return Error{r.error()};
    if (header.flags & kHasUvs)
        if (auto r = reader.take("TEXC", 3 * triangles, mesh.corner_uvs); !r) return Error{r.error()};
    if (header.flags & kHasMaterials)
        if (auto r = reader.take("MATE", triangles, mesh.materials); !r) return Error{r.error()};
    mesh.name.assign(mesh_name.begin(), mesh_name.end());
    if (auto r = validate_mesh(mesh, name); !r) return Error{r.error()};
    return mesh;
}

Error file_trouble(const std::string& path, const char* doing, int number) {
    return {quoted(path) + ": cannot " + doing + " (" + std::strerror(number) +
            "). Check the path, the rights and the disk."};
}

Result<void> write_bytes(std::span<const uint8_t> bytes, const std::string& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) return file_trouble(path, "create the file", errno);
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            const int number = n < 0 ? errno : ENOSPC;
            ::close(file);
            return file_trouble(path, "write the file", number);
        }
        done += static_cast<size_t>(n);
    }
    if (::close(file) != 0) return file_trouble(path, "close the file", errno);
    return {};
}

}  // namespace

std::string one_line(std::string text, size_t most_bytes) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    if (text.size() > most_bytes) text = text.substr(0, most_bytes - 3) + "...";
    return text;
}

Result<void> validate_mesh(const Mesh& mesh, const std::string& path) {
    const std::string name = quoted(path);
    if (auto r = validate_name(mesh, name); !r) return r;
    if (auto r = validate_counts(mesh, name); !r) return r;
    if (auto r = validate_positions(mesh, name); !r) return r;
    return validate_corners(mesh, name);
}

bool is_mesh_file(std::span<const uint8_t> bytes) {
    return bytes.size() >= sizeof kMagic && std::memcmp(bytes.data(), kMagic, sizeof kMagic) == 0;
}

Result<Mesh> parse_mesh_file(std::span<const uint8_t> bytes, const std::string& path) {
    const std::string name = quoted(path);
    try {
        auto header = parse_header(bytes, name);
        if (!header) return Error{header.error()};
        return parse_payload(*header, bytes.subspan(sizeof(Header)), name);
    } catch (const std::bad_alloc&) {
        return Error{name + ": no memory for " + text(bytes.size()) +
                     " bytes of mesh. Free memory or simplify the model."};
    }
}

Result<std::vector<uint8_t>> read_whole_file(const std::string& path, uint64_t most_bytes) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return file_trouble(path, "open the file", errno);
    struct stat status {};
    if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || static_cast<uint64_t>(status.st_size) > most_bytes) {
        ::close(file);
        return Error{quoted(path) + ": is no ordinary file of at most " + text(most_bytes) +
                     " bytes. Give the path of a model."};
    }
    std::vector<uint8_t> bytes;
    size_t done = 0;
    try {
        bytes.resize(static_cast<size_t>(status.st_size));
    } catch (const std::bad_alloc&) {
        ::close(file);
        return Error{quoted(path) + ": no memory for its " + text(static_cast<uint64_t>(status.st_size)) +
                     " bytes. Free memory."};
    }
    while (done < bytes.size()) {
        const ssize_t n = ::read(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        done += static_cast<size_t>(n);
    }
    const int number = errno;
    ::close(file);
    if (done != bytes.size()) return file_trouble(path, "read the file to its end", number);
    return bytes;
}

Result<Mesh> read_mesh_file(const std::string& path) {
    auto bytes = read_whole_file(path, kLargestFile);
    if (!bytes) return Error{bytes.error()};
    return parse_mesh_file(*bytes, path);
}

std::vector<uint8_t> encode_mesh_file(const Mesh& mesh) {
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    header.version = kVersion;
    header.flags = (mesh.corner_normals.empty() ? 0u : kHasNormals) | (mesh.corner_uvs.empty() ? 0u : kHasUvs) |
                   (mesh.materials.empty() ? 0u : kHasMaterials);
    header.vertices = mesh.positions.size();
    header.triangles = mesh.triangles.size();
    header.name_bytes = mesh.name.size();
    std::vector<Chunk> chunks{chunk("NAME", mesh.name), chunk("POSI", mesh.positions), chunk("TRIA", mesh.triangles)};
    if (header.flags & kHasNormals) chunks.push_back(chunk("NORM", mesh.corner_normals));
    if (header.flags & kHasUvs) chunks.push_back(chunk("TEXC", mesh.corner_uvs));
    if (header.flags & kHasMaterials) chunks.push_back(chunk("MATE", mesh.materials));
    for (const Chunk& c : chunks) header.payload_bytes += kChunkHeader + c.size;
    std::vector<uint8_t> out(sizeof header + header.payload_bytes);
    uint8_t* to = out.data() + sizeof header;
    for (const Chunk& c : chunks) to = put_chunk(to, c);
    header.payload_hash = XXH3_64bits(out.data() + sizeof header, header.payload_bytes);
    header.header_hash = XXH3_64bits(&header, offsetof(Header, header_hash));
    std::memcpy(out.data(), &header, sizeof header);
    return out;
}

Result<std::string> target_of(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return path;  // nothing there, or the trouble shows when it is written
    std::string target = path;
    if (S_ISLNK(status.st_mode)) {
        const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), std::free);
        if (real == nullptr || ::stat(real.get(), &status) != 0)
            return Error{quoted(path) + ": is a link that leads nowhere. Remove it or give another name."};
        target = real.get();
    }
    if (!S_ISREG(status.st_mode))
        return Error{quoted(path) + ": is no ordinary file, and is not written over. Give another name."};
    return target;
}

Result<void> write_whole_file(std::span<const uint8_t> bytes, const std::string& path) {
    const auto target = target_of(path);
    if (!target) return Error{target.error()};
    const std::string part = *target + "." + text(static_cast<uint64_t>(::gettid())) + ".part";
    if (auto r = write_bytes(bytes, part); !r) {
        ::unlink(part.c_str());
        return r;
    }
    if (::rename(part.c_str(), target->c_str()) != 0) {
        const int number = errno;
        ::unlink(part.c_str());
        return file_trouble(path, "put the new file in place", number);
    }
    return {};
}

Result<void> write_mesh_file(const Mesh& mesh, const std::string& path) {
    if (auto r = validate_mesh(mesh, path); !r) return r;
    return write_whole_file(encode_mesh_file(mesh), path);
}

}  // namespace cullet
