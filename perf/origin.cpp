#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "perf/figures.hpp"

namespace cullet::perf {
namespace {

/// What stands behind "key : " in /proc/cpuinfo the first time.
std::string processor_line(const std::string& key) {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind(key, 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::string vector_features() {
    std::istringstream words(processor_line("flags"));
    std::string found;
    for (std::string word; words >> word;)
        if (word.rfind("sse", 0) == 0 || word.rfind("avx", 0) == 0 || word == "fma")
            found += (found.empty() ? "" : " ") + word;
    return found;
}

std::string now_in_utc() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

}  // namespace

Origin describe_origin() {
    Origin origin;
    origin.processor = processor_line("model name");
    origin.features = vector_features();
    origin.hardware_threads = std::thread::hardware_concurrency();
#if defined(__clang__)
    origin.compiler = "clang " __clang_version__;
#else
    origin.compiler = "g++ " __VERSION__;
#endif
    origin.build = CULLET_BUILD_TYPE;
    origin.flags = CULLET_BUILD_FLAGS;
    origin.commit = CULLET_COMMIT;
    origin.date = now_in_utc();
    return origin;
}

}  // namespace cullet::perf
