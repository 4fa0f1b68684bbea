// What the command line says.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

enum class HashWhen { Every, Last, Off };

struct RunOptions {
    std::string scene, mesh;  // scene: the name of one, or a script's file
    std::string model;        // for what the script cooks; empty: the script's own
    uint32_t frames = 0;      // 0: the scene's
    double dt_ms = 1000.0 / 60;
    uint32_t threads = 0;  // 0: all that the machine has, or the key's
    uint32_t repeat = 1;
    std::string out;    // empty: nothing is written
    uint32_t draw = 0;  // every so many frames; 0: none
    bool has_sheet = false, has_video = false;
    std::string trace;
    HashWhen hash = HashWhen::Every;
    bool validates = false;
    std::vector<std::string> set;
};

enum class Command : uint8_t { Help, Run, KeysHelp, Frame, Truth };

struct TruthOptions {
    std::string model;
    uint32_t placements = 20, threads = 0;
    std::string out;  // a folder; empty: only printed
};

struct Options {
    Command command = Command::Help;
    std::string help;  // the text to print
    RunOptions run;
    TruthOptions truth;
};

/// The program's arguments without its name. A refusal is one sentence.
Result<Options> parse_options(std::vector<std::string> arguments);

}  // namespace cullet
