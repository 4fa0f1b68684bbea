// Files inside a ZIP, read by minizip.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace cullet {

class ZipFile {
 public:
    /// `path` leads to an ordinary file.
    explicit ZipFile(const std::string& path);
    ~ZipFile();
    ZipFile(const ZipFile&) = delete;
    ZipFile& operator=(const ZipFile&) = delete;

    bool is_open() const { return archive_ != nullptr; }
    /// Names as they stand in the archive.
    const std::vector<std::string>& names() const { return names_; }
    /// All bytes of the file of that name, whatever its letters' size and with or without a slash in front; nothing
    /// when there is none, it is encrypted, or its checksum does not fit. Grows with the bytes that are there: what
    /// the archive says of sizes is not believed.
    std::optional<std::string> read(const std::string& name) const;

 private:
    void* archive_ = nullptr;
    std::vector<std::string> names_;
};

}  // namespace cullet
