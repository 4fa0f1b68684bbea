#include "engine/import/gltf/part.hpp"

#include <cmath>

namespace cullet::gltf {
namespace {

/// The value in a sentence: short, or its kind.
std::string shown(const nlohmann::json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "a list";
    if (value.is_string()) return "a text";
    return value.dump();
}

}  // namespace

const nlohmann::json& Part::as_object() const {
    if (!value_->is_object()) refuse("is " + shown(*value_) + ", not an object");
    return *value_;
}

const nlohmann::json& Part::as_list() const {
    if (!value_->is_array()) refuse("is " + shown(*value_) + ", not a list");
    return *value_;
}

std::optional<Part> Part::find(const char* name) const {
    const nlohmann::json& object = as_object();
    const auto found = object.find(name);
    if (found == object.end()) return std::nullopt;
    return Part(*found, place_.empty() ? name : place_ + "." + name);
}

std::optional<Part> Part::find(std::initializer_list<const char*> names) const {
    std::optional<Part> part = *this;
    for (const char* name : names)
        if (part) part = part->find(name);
    return part;
}

Part Part::need(const char* name) const {
    std::optional<Part> part = find(name);
    if (!part) refuse("has no \"" + std::string(name) + "\"");
    return *part;
}

std::vector<std::string> Part::names() const {
    std::vector<std::string> names;
    for (const auto& member : as_object().items()) names.push_back(member.key());
    return names;
}

size_t Part::size() const {
    return as_list().size();
}

Part Part::item(size_t i) const {
    const nlohmann::json& list = as_list();
    if (i >= list.size()) refuse("has " + std::to_string(list.size()) + " entries, not " + std::to_string(i + 1));
    return Part(list[i], place_ + "[" + std::to_string(i) + "]");
}

uint64_t Part::whole(uint64_t most) const {
    const auto wrong = [&] {
        refuse("is " + shown(*value_) + ", not a whole number from 0 to " + std::to_string(most));
    };
    uint64_t number = 0;
    if (value_->is_number_unsigned()) {
        number = value_->get<uint64_t>();
    } else {
        const double real = value_->is_number() ? value_->get<double>() : -1;
        if (!(real >= 0 && real <= static_cast<double>(kLargestWhole)) || std::floor(real) != real) wrong();
        number = static_cast<uint64_t>(real);
    }
    if (number > most) wrong();
    return number;
}

double Part::number() const {
    const double number = value_->is_number() ? value_->get<double>() : NAN;
    if (!std::isfinite(number)) refuse("is " + shown(*value_) + ", not a number");
    return number;
}

bool Part::flag() const {
    if (!value_->is_boolean()) refuse("is " + shown(*value_) + ", not true or false");
    return value_->get<bool>();
}

const std::string& Part::text() const {
    if (!value_->is_string()) refuse("is " + shown(*value_) + ", not a text");
    return value_->get_ref<const std::string&>();
}

std::vector<double> Part::numbers() const {
    std::vector<double> numbers(size());
    for (size_t i = 0; i < numbers.size(); ++i) {
        const nlohmann::json& value = (*value_)[i];
        if (!value.is_number() || !std::isfinite(value.get<double>())) item(i).number();  // refuses
        numbers[i] = value.get<double>();
    }
    return numbers;
}

std::vector<double> Part::numbers(size_t wanted) const {
    if (size() != wanted) refuse("has " + std::to_string(size()) + " numbers, not " + std::to_string(wanted));
    return numbers();
}

uint64_t Part::whole(const char* name, uint64_t otherwise, uint64_t most) const {
    const auto part = find(name);
    return part ? part->whole(most) : otherwise;
}

bool Part::flag(const char* name, bool otherwise) const {
    const auto part = find(name);
    return part ? part->flag() : otherwise;
}

}  // namespace cullet::gltf
