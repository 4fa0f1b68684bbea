// Files of models that are found by the hash of their bytes.
#pragma once
#include <cstdio>
#include <string>

#include "engine/checksum.hpp"

namespace cullet {

/// 32 hexadecimal digits and ".cmodel".
inline std::string model_file_name(const Checksum& hash) {
    char name[48];
    std::snprintf(name, sizeof name, "%016llx%016llx.cmodel", static_cast<unsigned long long>(hash.high),
                  static_cast<unsigned long long>(hash.low));
    return name;
}

}  // namespace cullet
