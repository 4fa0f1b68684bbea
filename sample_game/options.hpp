// What the command line says.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "sample_game/finish.hpp"
#include "sample_game/metal/fem_command.hpp"
#include "sample_game/reproduce/command.hpp"

namespace cullet {

enum class HashWhen { Every, Last, Off };

struct RunOptions {
    std::string scene, mesh;  // scene: the name of one, or a script's file
    std::string materials;    // a TOML file; empty: the compiled table
    std::string model;        // for what the script cooks; empty: the script's own
    uint32_t frames = 0;      // 0: the scene's
    double dt_ms = 1000.0 / 60;
    uint32_t threads = 0;  // 0: all that the machine has, or the key's
    uint32_t repeat = 1;
    std::string out;    // empty: nothing is written
    uint32_t draw = 0;  // every so many frames; 0: none
    bool has_sheet = false, has_video = false;
    PictureLook look = PictureLook::Material;
    uint32_t width = 960;  // of pictures, pixels; 16 to 9
    std::string trace, record;
    HashWhen hash = HashWhen::Every;
    bool validates = false;
    std::vector<std::string> set;
};

enum class Command : uint8_t { Help, Run, KeysHelp, Settings, Frame, Truth, Cook, Replay, Reproduce, Fem };

struct ReplayOptions {
    std::string file;
    std::vector<uint32_t> against;  // threads; empty: 1
};

struct CookOptions {
    std::string model;                                                   // the damage model; empty: the material's
    std::string mesh, out, material = "porcelain", materials, fracture;  // the last two may be empty
    double thickness_m = 0;                                              // 0: 1.5 % of the largest side
    double edge_m = 0;                                                   // 0: what cooking chooses
    double weld = 0;                                                     // of the diagonal
    uint64_t seed = 1;
    bool keeps_walls_apart = false;
    std::string draw;                             // "cells": a picture beside the model file; empty: none
    std::map<std::string, std::string> of_model;  // settings of the damage model's own, by name
};

struct TruthOptions {
    std::string model;
    uint32_t placements = 40, threads = 0;
    std::string out;  // a folder; empty: only printed
};

struct Options {
    Command command = Command::Help;
    std::string help;  // the text to print
    RunOptions run;
    TruthOptions truth;
    CookOptions cook;
    ReplayOptions replay;
    reproduce::CommandOptions reproduce;
    FemOptions fem;
};

/// The program's arguments without its name. A refusal is one sentence.
Result<Options> parse_options(std::vector<std::string> arguments);

}  // namespace cullet
