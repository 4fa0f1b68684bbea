#include "perf/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace cullet::perf {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double Figure::value() const {
    return median(values);
}

double Figure::noise() const {
    const double middle = value();
    std::vector<double> distances;
    for (const double v : values) distances.push_back(std::abs(v - middle));
    return 1.4826 * median(std::move(distances));
}

Figure& Figures::figure(const std::string& name, const std::string& unit, double limit, bool is_least) {
    const auto known =
        std::find_if(all_.begin(), all_.end(), [&](const Figure& f) { return f.scene == scene_ && f.name == name; });
    if (known != all_.end()) return *known;
    all_.push_back({scene_, name, unit, {}, limit, is_least, {}, {}, {}});
    return all_.back();
}

void Figures::add(const std::string& name, double value, const std::string& unit, double limit, bool is_least) {
    figure(name, unit, limit, is_least).values.push_back(value);
}

void Figures::add_ratio(const std::string& name, double ours, double theirs, const std::string& parts_unit,
                        double limit, bool is_least) {
    Figure& f = figure(name, "x", limit, is_least);
    f.values.push_back(is_least ? theirs / ours : ours / theirs);
    f.ours.push_back(ours);
    f.theirs.push_back(theirs);
    f.parts_unit = parts_unit;
}

uint32_t Figures::missed() const {
    return static_cast<uint32_t>(
        std::count_if(all_.begin(), all_.end(), [](const Figure& f) { return f.is_missed(); }));
}

namespace {

void print_line(const Figure& f) {
    std::printf("  %-72s", f.name.c_str());
    if (f.ours.empty())
        std::printf(" %10.4g %10s %-14s %8s", f.value(), "", f.unit.c_str(), "");
    else
        std::printf(" %10.4g %10.4g %-14s %7.3gx", median(f.ours), median(f.theirs), f.parts_unit.c_str(), f.value());
    char limit[48] = "";
    if (f.limit > 0) std::snprintf(limit, sizeof limit, "%s %g", f.is_least ? ">=" : "<=", f.limit);
    std::printf("  %-10s", limit);
    if (f.values.size() > 1 && f.value() != 0) std::printf(" %6.1f %%", 100 * f.noise() / std::abs(f.value()));
    std::printf("%s\n", f.is_missed() ? "  MISSED" : "");
}

}  // namespace

void Figures::print() const {
    std::string scene;
    for (const Figure& f : all_) {
        if (f.scene != scene)
            std::printf("%-74s %10s %10s %-14s %8s  %-10s %8s\n", f.scene.c_str(), "ours", "yardstick", "unit", "ratio",
                        "limit", "noise");
        scene = f.scene;
        print_line(f);
    }
}

std::string Figures::json(const Origin& origin) const {
    nlohmann::ordered_json json;
    json["format"] = "cullet_perf 1";
    json["machine"] = {
        {"processor", origin.processor}, {"hardware_threads", origin.hardware_threads}, {"features", origin.features}};
    json["build"] = {
        {"compiler", origin.compiler}, {"type", origin.build}, {"flags", origin.flags}, {"commit", origin.commit}};
    json["date"] = origin.date;
    json["simd"] = origin.simd;
    json["passes"] = origin.passes;
    json["figures"] = nlohmann::ordered_json::array();
    for (const Figure& f : all_) {
        nlohmann::ordered_json figure{{"scene", f.scene}, {"name", f.name},     {"value", f.value()},
                                      {"unit", f.unit},   {"noise", f.noise()}, {"passes", f.values.size()}};
        if (!f.ours.empty()) {
            figure["ours"] = median(f.ours);
            figure["yardstick"] = median(f.theirs);
            figure["parts_unit"] = f.parts_unit;
        }
        if (f.limit > 0) figure[f.is_least ? "at_least" : "at_most"] = f.limit;
        json["figures"].push_back(figure);
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace cullet::perf
