// A plot as SVG: lines or points over two axes.
#pragma once
#include <string>
#include <vector>

namespace cullet::reproduce {

struct PlotLine {
    std::string name;
    std::vector<double> x, y;
    bool is_dashed = false;
};
struct Plot {
    std::string x_name, y_name;
    std::vector<PlotLine> lines;
};
std::string to_svg(const Plot& plot);

}  // namespace cullet::reproduce
