// Where the tests find what they read and run. Functions and not macros, so that all tests are compiled with the same flags.
#pragma once
#include <string>

namespace cullet {

/// The folder of this checkout.
std::string source_folder();
/// The folder of this build, with its programs.
std::string build_folder();
/// The compiler of this build.
std::string compiler();

}  // namespace cullet
