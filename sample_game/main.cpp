// Plays scenes without a window and writes down how they went.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cullet/world.hpp"
#include "sample_game/cook_command.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/options.hpp"
#include "sample_game/replay_command.hpp"
#include "sample_game/reproduce/command.hpp"
#include "sample_game/run_scene.hpp"
#include "sample_game/truth.hpp"

namespace cullet {
namespace {

int print_keys(const std::string& scene) {
    const Result<std::string> keys = keys_help(scene);
    if (keys.ok())
        fmt::print("{}", keys.value());
    else
        fmt::print(stderr, "{}\n", keys.error());
    return keys.ok() ? 0 : 2;
}

int run(const Options& options) {
    switch (options.command) {
        case Command::Help:
            fmt::print("{}", options.help);
            return 0;
        case Command::KeysHelp:
            return print_keys(options.run.scene);
        case Command::Settings:
            fmt::print("{}", settings_table());
            return 0;
        case Command::Frame:
            fmt::print("{}", World::describe_frame());
            return 0;
        case Command::Run:
            return run_command(options.run);
        case Command::Cook:
            return cook_command(options.cook);
        case Command::Replay:
            return replay_command(options.replay);
        case Command::Reproduce:
            return reproduce::run(options.reproduce);
        case Command::Fem:
            return run_fem(options.fem);
        case Command::Truth:
            break;
    }
    return run_truth(options.truth.model, {options.truth.placements, options.truth.threads, options.truth.out});
}

/// What is left in the buffer may be all that was printed.
int run_and_flush(const Options& options) {
    const int code = run(options);
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    std::fputs("sample_game: not all could be written to the standard output; its disk may be full.\n", stderr);
    return code == 0 ? 2 : code;
}

}  // namespace
}  // namespace cullet

// What fmt::print and the standard library throw, such as on a full disk, ends here in a sentence.
int main(int count, char** arguments) {
    try {
        const cullet::Result<cullet::Options> options = cullet::parse_options({arguments + 1, arguments + count});
        if (options.ok()) return cullet::run_and_flush(options.value());
        std::fprintf(stderr, "%s\n", options.error().c_str());
    } catch (const std::bad_alloc&) {
        std::fputs("sample_game: the machine has no memory left for this.\n", stderr);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "sample_game: %s.\n", e.what());
    }
    return 2;
}
