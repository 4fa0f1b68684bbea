// sample_game reproduce: a published work's claims beside what this program does, by one command.
#pragma once
#include <string>

namespace cullet::reproduce {

struct CommandOptions {
    std::string model;  // damage model whose published work it is: one of known_models()
    std::string out;    // a folder; made when it is not there
    std::string data;   // of test meshes; empty: CULLET_TEST_DATA, or ../shared/data
    uint32_t threads = 0;
    bool is_reduced = false;
    std::string only;  // one claim by its id; empty: all
};

/// Names of the damage models that have a page: "thick_shell, ...".
std::string known_models();
/// Writes report.html, report.json and the pictures, and prints a line for each claim. The exit code: 0 when the page
/// stands, whatever the verdicts; 1 when something could not be made; 2 for what cannot be asked.
int run(const CommandOptions& options);

}  // namespace cullet::reproduce
