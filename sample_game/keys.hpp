// The settings of a scene: a short list of named numbers (and one name) that --set changes. Nothing else has a say.
#pragma once
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

/// One line of --set help. A key of text has `choices` and no range.
struct Key {
    std::string name, unit;  // unit "1": a pure number
    double value = 0;
    double least = 0, most = 0;
    std::string text;     // what it is, for people
    std::string choices;  // "glass, porcelain": the key holds one of these words
    std::string word;
};

class Keys {
 public:
    Keys& number(std::string name, std::string unit, double value, double least, double most, std::string text);
    Keys& word(std::string name, std::string value, std::string choices, std::string text);

    /// The key must be in the list: scenes read what they declared.
    double operator[](const std::string& name) const;
    const std::string& word_of(const std::string& name) const;
    bool has(const std::string& name) const { return find(name) != nullptr; }

    /// "scene.speed_mps=8". Refuses a key that is not in the list, a value that is no number, and one out of range.
    Result<void> set(const std::string& assignment);
    /// Another value for a number, from within: no range is looked at.
    void put(const std::string& name, double value);
    /// One line a key: name, default, unit, range, text.
    std::string help() const;
    const std::vector<Key>& all() const { return keys_; }

 private:
    const Key* find(const std::string& name) const;
    std::vector<Key> keys_;
};

}  // namespace cullet
