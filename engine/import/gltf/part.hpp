// The JSON of a glTF, asked strictly. A part knows where it stands, so that a refusal can say so: whatever is not as
// the format wants it throws a Refusal, which read_gltf turns into its one sentence.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cullet::gltf {

/// What is wrong and where, without the file's name and without a full stop; and what to do about it.
struct Refusal : std::runtime_error {
    explicit Refusal(const std::string& what, std::string what_to_do = "Repair the file or export it again.")
        : std::runtime_error(what), remedy(std::move(what_to_do)) {}
    std::string remedy;
};

class Part {
 public:
    /// `place` is what a person finds it by: "meshes[2].primitives[0]". `value` must outlive the part.
    Part(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

    const std::string& place() const { return place_; }
    [[noreturn]] void refuse(const std::string& what) const {
        throw Refusal((place_.empty() ? "the file" : place_) + " " + what);
    }

    /// A member of this object, if it is there.
    std::optional<Part> find(const char* name) const;
    /// Down through objects in objects, if all of them are there.
    std::optional<Part> find(std::initializer_list<const char*> names) const;
    Part need(const char* name) const;
    /// The names of this object's members, in the order of the alphabet.
    std::vector<std::string> names() const;

    /// Of this list.
    size_t size() const;
    Part item(size_t i) const;

    /// This value. A whole number may be written 3.0, as scripts do.
    uint64_t whole(uint64_t most) const;
    double number() const;
    bool flag() const;
    const std::string& text() const;
    std::vector<double> numbers() const;
    std::vector<double> numbers(size_t wanted) const;

    /// A member's value, or what stands for one that is not there.
    uint64_t whole(const char* name, uint64_t otherwise, uint64_t most) const;
    bool flag(const char* name, bool otherwise) const;

 private:
    const nlohmann::json& as_object() const;
    const nlohmann::json& as_list() const;

    const nlohmann::json* value_;
    std::string place_;
};

constexpr uint64_t kLargestWhole = 1ull << 53;  // what JSON carries without loss

}  // namespace cullet::gltf
