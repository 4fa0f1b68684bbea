// What a script gives to a call: a table of named values, read one by one. A value that is missing or wrong, or a name
// that the call does not know, ends the script with a sentence that starts with file and line.
#pragma once
#include <string>
#include <vector>

#include "cullet/world.hpp"
#include "sample_game/script/sandbox.hpp"

namespace cullet {

/// What a number has to be, in words and from least to most.
struct Wanted {
    const char* text;
    double least, most;
};
inline constexpr Wanted kAnyNumber{"a number", -1e300, 1e300};
inline constexpr Wanted kLength{"a length in m above 0, at most 10000", 1e-6, 1e4};
inline constexpr Wanted kMass{"a mass in kg above 0, at most 1e9", 1e-9, 1e9};
inline constexpr Wanted kPlace{"a place in m, at most 1000000 from the origin", -1e6, 1e6};
inline constexpr Wanted kSpeed{"a velocity in m/s, at most 100000", -1e5, 1e5};
inline constexpr Wanted kShare{"a share from 0 to 1", 0, 1};

class Arguments {
 public:
    /// The table at `place`; `can_be_missing`: nothing at all is a table without values.
    Arguments(lua_State* lua, const char* call, const std::vector<const char*>& known, bool can_be_missing = false,
              int place = 1);

    bool has(const char* name) const;
    double number(const char* name, const Wanted& wanted) const;
    double number(const char* name, const Wanted& wanted, double otherwise) const;
    float real(const char* name, const Wanted& wanted, double otherwise) const;
    bool is(const char* name, bool otherwise) const;
    std::string word(const char* name, const char* expected) const;
    std::string word(const char* name, const char* expected, const std::string& otherwise) const;
    Vec3 vector(const char* name, const Wanted& wanted) const;
    Vec3 vector(const char* name, const Wanted& wanted, Vec3 otherwise) const;
    /// {axis = {x, y, z}, angle = radians}, or {x =, y =, z =, w =}.
    Quat turn(const char* name) const;
    ContactSettings contact() const;  // friction, restitution, rolling_friction
    Motion motion() const;            // velocity, spin
    /// Leaves the value on the stack.
    void push(const char* name) const;
    /// Takes it off again.
    void pop() const;
    [[noreturn]] void refuse_value(const char* name, const std::string& expected) const;
    [[noreturn]] void refuse(const std::string& sentence) const;

 private:
    lua_State* lua_;
    const char* call_;
    int place_;
};

/// {1, 2, 3} or {x = 1, y = 2, z = 3} at `place`; `what` starts the sentence of a refusal: "game.spawn: at".
Vec3 read_vector(lua_State* lua, int place, const std::string& what, const Wanted& wanted);
/// {x =, y =, z =}.
void push_vector(lua_State* lua, Vec3 v);
void push_turn(lua_State* lua, Quat q);

}  // namespace cullet
