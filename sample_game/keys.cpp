#include "sample_game/keys.hpp"

#include <fmt/format.h>

#include <charconv>

#include "engine/assert.hpp"

namespace cullet {
namespace {

/// The whole text as a number; "inf" is one.
bool read_number(const std::string& text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value == value;
}

// As short as a person would write it: what was a float comes with a float's digits, 0.1 and not 0.10000000149011612.
std::string short_number(double value) {
    const auto narrow = static_cast<float>(value);
    return static_cast<double>(narrow) == value ? fmt::format("{}", narrow) : fmt::format("{}", value);
}

bool is_choice(const std::string& choices, const std::string& word) {
    return !word.empty() && (", " + choices + ",").find(", " + word + ",") != std::string::npos;
}

}  // namespace

Keys& Keys::number(std::string name, std::string unit, double value, double least, double most, std::string text) {
    keys_.push_back({std::move(name), std::move(unit), value, least, most, std::move(text), "", ""});
    return *this;
}

Keys& Keys::word(std::string name, std::string value, std::string choices, std::string text) {
    keys_.push_back({std::move(name), "", 0, 0, 0, std::move(text), std::move(choices), std::move(value)});
    return *this;
}

const Key* Keys::find(const std::string& name) const {
    for (const Key& key : keys_)
        if (key.name == name) return &key;
    return nullptr;
}

double Keys::operator[](const std::string& name) const {
    const Key* key = find(name);
    CULLET_ASSERT(key, "the scene reads %s, which it did not declare", name.c_str());
    return key ? key->value : 0;
}

const std::string& Keys::word_of(const std::string& name) const {
    static const std::string nothing;
    const Key* key = find(name);
    CULLET_ASSERT(key, "the scene reads %s, which it did not declare", name.c_str());
    return key ? key->word : nothing;
}

Result<void> Keys::set(const std::string& assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos)
        return Error{fmt::format("--set {}: this is not KEY=VALUE; --set help lists the keys.", assignment)};
    const std::string name = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    Key* key = const_cast<Key*>(find(name));
    if (!key) {
        std::string names;
        for (const Key& k : keys_) names += (names.empty() ? "" : ", ") + k.name;
        return Error{fmt::format("--set {}: this scene has no key {}; it has {}.", assignment, name, names)};
    }
    if (!key->choices.empty()) {
        if (!is_choice(key->choices, value))
            return Error{fmt::format("--set {}: {} is one of {}.", assignment, name, key->choices)};
        key->word = value;
        return {};
    }
    double number = 0;
    if (!read_number(value, number))
        return Error{fmt::format("--set {}: \"{}\" is not a number; give {} in {}.", assignment, value, name,
                                 key->unit == "1" ? "plain digits" : key->unit)};
    if (number < key->least || number > key->most)
        return Error{fmt::format("--set {}: {} is from {} to {}{}.", assignment, name, short_number(key->least),
                                 short_number(key->most),
                                 key->unit.empty() || key->unit == "1" ? "" : " " + key->unit)};
    key->value = number;
    return {};
}

void Keys::put(const std::string& name, double value) {
    Key* key = const_cast<Key*>(find(name));
    CULLET_ASSERT(key, "there is no key %s to put a value into", name.c_str());
    if (key) key->value = value;
}

std::string Keys::help() const {
    std::string text;
    for (const Key& key : keys_) {
        if (!key.choices.empty())
            text += fmt::format("    {:<23} {:<10} {}: {}\n", key.name, key.word, key.text, key.choices);
        else
            text += fmt::format("    {:<23} {:<10} {} ({} to {}{})\n", key.name, short_number(key.value), key.text,
                                short_number(key.least), short_number(key.most), key.unit == "1" ? "" : " " + key.unit);
    }
    return text;
}

}  // namespace cullet
