#include "perf/compare.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace cullet::perf {
namespace {

using Json = nlohmann::json;

const std::string* text_at(const Json& object, const char* key) {
    const auto at = object.find(key);
    return at == object.end() ? nullptr : at->get_ptr<const std::string*>();
}

/// Of an object; false: missing, no number, not finite.
bool read_number(const Json& object, const char* key, double& value) {
    const auto at = object.find(key);
    if (at == object.end() || !at->is_number()) return false;
    value = at->get<double>();
    return std::isfinite(value);
}

std::string read_figure(const Json& json, ReadFigure& figure) {
    if (!json.is_object()) return "is no object";
    const std::string *scene = text_at(json, "scene"), *name = text_at(json, "name"), *unit = text_at(json, "unit");
    if (!scene || !name || !unit) return "lacks the text \"scene\", \"name\" or \"unit\"";
    if (!read_number(json, "value", figure.value)) return "(" + *name + ") lacks the number \"value\"";
    if (!read_number(json, "noise", figure.noise) || figure.noise < 0)
        return "(" + *name + ") lacks the number \"noise\" of at least 0";
    figure.scene = *scene, figure.name = *name, figure.unit = *unit;
    return {};
}

std::string key_of(const ReadFigure& figure) {
    return figure.scene + ": " + figure.name;
}

}  // namespace

Result<FigureFile> parse_figures(std::string_view text, const std::string& name) {
    const std::string advice = ". Give a file that cullet_perf --json wrote.";
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{name + ": is no JSON object" + advice};
    const std::string* format = text_at(json, "format");
    if (!format || *format != "cullet_perf 1")
        return Error{name + ": its \"format\" is not \"cullet_perf 1\"" + advice};
    const auto machine = json.find("machine"), figures = json.find("figures");
    double threads = 0;
    if (machine == json.end() || !machine->is_object() || !text_at(*machine, "processor") ||
        !read_number(*machine, "hardware_threads", threads))
        return Error{name + ": \"machine\" lacks \"processor\" or \"hardware_threads\"" + advice};
    if (figures == json.end() || !figures->is_array()) return Error{name + ": \"figures\" is no list" + advice};
    FigureFile file;
    const std::string* simd = text_at(json, "simd");
    if (!simd || !read_number(json, "passes", file.passes))
        return Error{name + ": lacks \"simd\" or \"passes\"" + advice};
    file.machine =
        *text_at(*machine, "processor") + ", " + (*machine)["hardware_threads"].dump() + " threads, kernels: " + *simd;
    std::map<std::string, size_t> seen;
    for (const Json& entry : *figures) {
        const size_t index = file.figures.size();
        ReadFigure figure;
        const std::string trouble = read_figure(entry, figure);
        if (!trouble.empty()) return Error{name + ": figure " + std::to_string(index) + " " + trouble + advice};
        const auto [first, is_new] = seen.emplace(key_of(figure), index);
        if (!is_new)
            return Error{name + ": figures " + std::to_string(first->second) + " and " + std::to_string(index) +
                         " are both \"" + first->first + "\"" + advice};
        file.figures.push_back(std::move(figure));
    }
    return file;
}

Result<FigureFile> read_figures(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{path + ": cannot be opened. Give a file that cullet_perf --json wrote."};
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return parse_figures(text, path);
}

bool has_moved(const ReadFigure& before, const ReadFigure& after) {
    const double by = std::abs(after.value - before.value);
    return by > kNoises * std::hypot(before.noise, after.noise) && by > kLeastMove * std::abs(before.value);
}

Comparison compare(const FigureFile& before, const FigureFile& after) {
    std::map<std::string, const ReadFigure*> old;
    for (const ReadFigure& f : before.figures) old.emplace(key_of(f), &f);
    Comparison result;
    for (const ReadFigure& f : after.figures) {
        const auto at = old.find(key_of(f));
        if (at == old.end() || at->second->unit != f.unit) {
            result.gained.push_back(key_of(f));
            continue;
        }
        if (has_moved(*at->second, f)) result.moved.push_back({*at->second, f});
        old.erase(at);
    }
    for (const ReadFigure& f : before.figures)
        if (old.count(key_of(f))) result.missing.push_back(key_of(f));
    return result;
}

std::string describe(const Comparison& comparison) {
    std::string text;
    for (const auto& [before, after] : comparison.moved) {
        char numbers[160], share[32] = "from 0";
        if (before.value != 0)
            std::snprintf(share, sizeof share, "%+.1f %%", 100 * (after.value - before.value) / std::abs(before.value));
        std::snprintf(numbers, sizeof numbers, "%.4g -> %.4g ", before.value, after.value);
        text += key_of(after) + "  " + numbers + after.unit + "  " + share;
        std::snprintf(numbers, sizeof numbers, "  (noise %.2g and %.2g)\n", before.noise, after.noise);
        text += numbers;
    }
    for (const std::string& name : comparison.missing) text += name + "  only in the old file\n";
    for (const std::string& name : comparison.gained) text += name + "  only in the new file\n";
    return text;
}

}  // namespace cullet::perf
