// Text as a page shows it.
#pragma once
#include <string>

namespace cullet {

/// With its signs that mean something in HTML written as such.
std::string escaped(const std::string& text);

}  // namespace cullet
