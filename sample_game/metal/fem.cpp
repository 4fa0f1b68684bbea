#include "sample_game/metal/fem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "systems/models/metal_shell/dent/sheet_plan.hpp"

namespace cullet {
namespace {

constexpr double kElement = 0.025;  // m, of the reference decks

Error unreadable(const std::string& path, const std::string& what) {
    return Error{path + ": " + what};
}

/// Lines of a quarter along one side, from the middle: even ones under the patch, and even ones beyond.
std::vector<double> lines_to(double half, double half_patch) {
    std::vector<double> lines{0};
    const double size = std::min(kElement, half_patch / 2);
    const auto under = static_cast<int>(std::lround(half_patch / size));
    for (int k = 1; k <= under; ++k) lines.push_back(half_patch * k / under);
    const auto beyond = std::max(1, static_cast<int>(std::lround((half - half_patch) / kElement)));
    for (int k = 1; k <= beyond; ++k) lines.push_back(half_patch + (half - half_patch) * k / beyond);
    return lines;
}

/// Nodes of a quarter: of elements with eight nodes, those at corners and at middles of sides.
struct Quarter {
    std::vector<double> x, y;  // lines, with those through the middles between them
    std::map<std::pair<size_t, size_t>, int> node;

    explicit Quarter(const FemCase& of) {
        const auto refined = [](const std::vector<double>& lines) {
            std::vector<double> all;
            for (size_t k = 0; k < lines.size(); ++k) {
                if (k > 0) all.push_back(0.5 * (lines[k - 1] + lines[k]));
                all.push_back(lines[k]);
            }
            return all;
        };
        x = refined(lines_to(0.5 * of.width, 0.5 * of.patch)), y = refined(lines_to(0.5 * of.height, 0.5 * of.patch));
        int next = 1;
        for (size_t j = 0; j < y.size(); ++j)
            for (size_t i = 0; i < x.size(); ++i)
                if (i % 2 == 0 || j % 2 == 0) node[{i, j}] = next++;
    }
};

std::string node_set(const Quarter& quarter, const char* name, bool (*is_in)(size_t, size_t, size_t, size_t)) {
    std::string text = fmt::format("*NSET,NSET={}\n", name);
    for (const auto& [at, id] : quarter.node)
        if (is_in(at.first, at.second, quarter.x.size() - 1, quarter.y.size() - 1)) text += fmt::format("{},\n", id);
    return text;
}

Result<std::string> text_of(const std::string& path) {
    std::ifstream file(path);
    if (!file) return unreadable(path, "cannot be read; give a curve of the reference, or what ccx printed.");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

// The contact of a ball grows with it at the same work.
double radius_for_contact(const SheetMetal& metal, double support, double work, double contact) {
    double low = 1.01 * contact, high = 40 * contact;
    for (int k = 0; k < 60; ++k) {
        const double r = 0.5 * (low + high);
        (plan_sheet(metal, {r, support, work, 0, true}).contact < contact ? low : high) = r;
    }
    return 0.5 * (low + high);
}

}  // namespace

double FemCurve::at(double place) const {
    const double away = std::fabs(place);
    for (size_t k = 1; k < x.size(); ++k)
        if (away <= x[k]) {
            const double share = (away - x[k - 1]) / (x[k] - x[k - 1]);
            return depth[k - 1] + share * (depth[k] - depth[k - 1]);
        }
    return depth.empty() ? 0 : depth.back();
}

Result<FemCurve> read_fem_curve(const std::string& path) {
    const Result<std::string> text = text_of(path);
    if (!text.ok()) return Error{text.error()};
    std::istringstream lines(*text);
    FemCurve curve;
    bool is_next = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("work ~") != std::string::npos) curve.work = std::atof(line.c_str() + line.find('~') + 1);
        if (is_next && curve.x.empty()) {
            std::istringstream pairs(line);
            for (std::string pair; pairs >> pair;) {
                const size_t colon = pair.find(':');
                if (colon == std::string::npos) return unreadable(path, "\"" + pair + "\" is no place and deflection.");
                curve.x.push_back(std::fabs(std::atof(pair.c_str())));
                curve.depth.push_back(-1e-3 * std::atof(pair.c_str() + colon + 1));
            }
        }
        is_next = line.find("unloaded") != std::string::npos;
    }
    if (curve.x.size() < 2) return unreadable(path, "has no line \"... unloaded\" with \"x:mm\" pairs below it.");
    if (!std::is_sorted(curve.x.begin(), curve.x.end()))
        return unreadable(path, "its places do not rise from the middle.");
    return curve;
}

std::string fem_deck(const FemCase& of) {
    const Quarter quarter(of);
    std::string text = "*NODE,NSET=NALL\n";
    for (const auto& [at, id] : quarter.node)
        text += fmt::format("{},{:.9g},{:.9g},0\n", id, quarter.x[at.first], quarter.y[at.second]);
    text += "*ELEMENT,TYPE=S8R,ELSET=EALL\n";
    std::string pressed = "*ELSET,ELSET=EP\n";
    int element = 0;
    for (size_t j = 0; j + 2 < quarter.y.size(); j += 2)
        for (size_t i = 0; i + 2 < quarter.x.size(); i += 2) {
            ++element;
            const auto node = [&](size_t di, size_t dj) { return quarter.node.at({i + di, j + dj}); };
            text += fmt::format("{},{},{},{},{},{},{},{},{}\n", element, node(0, 0), node(2, 0), node(2, 2), node(0, 2),
                                node(1, 0), node(2, 1), node(1, 2), node(0, 1));
            if (quarter.x[i + 1] < 0.5 * of.patch && quarter.y[j + 1] < 0.5 * of.patch)
                pressed += fmt::format("{},\n", element);
        }
    text += pressed;
    text += node_set(quarter, "SX", [](size_t i, size_t, size_t, size_t) { return i == 0; });
    text += node_set(quarter, "SY", [](size_t, size_t j, size_t, size_t) { return j == 0; });
    text += node_set(quarter, "CL", [](size_t i, size_t j, size_t ni, size_t nj) { return i == ni || j == nj; });
    text += node_set(quarter, "MID", [](size_t, size_t j, size_t, size_t) { return j == 0; });
    text +=
        fmt::format("*MATERIAL,NAME=ST\n*ELASTIC\n{:.6g},{:.6g}\n*PLASTIC\n{:.6g},0\n{:.6g},0.05\n{:.6g},0.2\n",
                    of.young_modulus, of.poisson_ratio, of.yield_stress, 1.2 * of.yield_stress, 1.4 * of.yield_stress);
    text += fmt::format("*SHELL SECTION,ELSET=EALL,MATERIAL=ST\n{:.6g}\n", of.thickness);
    text += "*BOUNDARY\nSX,1,1\nSX,5,6\nSY,2,2\nSY,4,4\nSY,6,6\nCL,1,6\n";
    text += "*AMPLITUDE,NAME=A1\n0,0,1,1\n*AMPLITUDE,NAME=A2\n0,1,1,0\n";
    text +=
        fmt::format("*STEP,NLGEOM,INC=400\n*STATIC\n0.02,1,1e-5,0.1\n*DLOAD,AMPLITUDE=A1\nEP,P,{:.6g}\n", -of.pressure);
    text += "*NODE PRINT,NSET=MID,FREQUENCY=1\nU\n*EL PRINT,ELSET=EALL,TOTALS=ONLY,FREQUENCY=1\nELSE\n*END STEP\n";
    text +=
        fmt::format("*STEP,NLGEOM,INC=400\n*STATIC\n0.1,1,1e-5,0.25\n*DLOAD,AMPLITUDE=A2\nEP,P,{:.6g}\n", -of.pressure);
    text += "*NODE PRINT,NSET=MID,FREQUENCY=1\nU\n*END STEP\n";
    return text;
}

// Blocks of displacements, of which the last is the unloaded one, and totals of internal energy, of which the largest
// is the work of the press on a quarter.
Result<FemCurve> read_fem_results(const std::string& path, const FemCase& of) {
    const Result<std::string> text = text_of(path);
    if (!text.ok()) return Error{text.error()};
    const Quarter quarter(of);
    std::map<int, double> x_of;
    for (const auto& [at, id] : quarter.node)
        if (at.second == 0) x_of[id] = quarter.x[at.first];
    std::map<double, double> last, block;
    double energy = 0, time = 0, now = 0;
    enum class Part : uint8_t { None, Places, Energy } part = Part::None;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);) {
        if (const size_t at = line.find("and time"); at != std::string::npos) {
            now = std::atof(line.c_str() + at + 8);
            part = line.find("displacements") != std::string::npos ? Part::Places
                   : line.find("energy") != std::string::npos      ? Part::Energy
                                                                   : Part::None;
            block.clear();
            continue;
        }
        std::istringstream numbers(line);
        int id = 0;
        double u = 0, v = 0, w = 0;
        if (part == Part::Places && numbers >> id >> u >> v >> w && x_of.contains(id)) {
            block[x_of[id]] = -w;
            last = block, time = now;
        }
        if (part == Part::Energy && (numbers.clear(), numbers.seekg(0), numbers >> u)) energy = std::max(energy, u);
    }
    if (last.size() != x_of.size())
        return unreadable(path, fmt::format("has {} of {} places of the mid-line; was it made of this deck?",
                                            last.size(), x_of.size()));
    if (std::fabs(time - 2) > 1e-6)
        return unreadable(path, fmt::format("ends at time {} and not at 2: ccx gave up.", time));
    FemCurve curve;
    for (const auto& [x, w] : last) curve.x.push_back(x), curve.depth.push_back(w);
    curve.work = 4 * energy;
    return curve;
}

FemMeasures compare_with_fem(const MidLine& ours, const FemCurve& curve) {
    FemMeasures m;
    double off = 0, moved = 0, low = 1e30, high = -1e30, our_peak = 0, peak = 0, our_place = 0, place = 0;
    for (size_t k = 0; k < ours.x.size(); ++k) {
        const double theirs = curve.at(ours.x[k]);
        off += std::fabs(ours.depth[k] - theirs), moved += std::fabs(theirs);
        low = std::min(low, theirs), high = std::max(high, theirs);
        if (ours.depth[k] > our_peak) our_peak = ours.depth[k], our_place = ours.x[k];
        if (theirs > peak) peak = theirs, place = ours.x[k];
    }
    const auto count = static_cast<double>(ours.x.size());
    m.a = 1 - off / count / (high - low);
    m.b = 1 - off / moved;
    m.peak_ratio = our_peak / peak;
    m.peak_off = std::fabs(our_place - place) / (ours.x.back() - ours.x.front());
    return m;
}

Result<FemDent> dent_of(const FemCase& of, const FemBlow& blow) {
    const Result<Model> model =
        cook_metal_mesh(metal_sheet(of.width, of.height, blow.columns, blow.rows), of.material, of.thickness);
    if (!model.ok()) return Error{model.error()};
    MetalCookSettings settings;
    settings.cells.count = blow.cells;
    settings.published = blow.published;
    MetalBench bench(*model, &settings);
    bench.set_yield(of.yield_stress);
    bench.clamp();
    FemDent made;
    made.ball_radius = blow.ball_radius;
    if (!(made.ball_radius > 0))
        made.ball_radius = radius_for_contact(sheet_metal(bench.view()), 0.5 * std::min(of.width, of.height), blow.work,
                                              of.patch / std::sqrt(std::numbers::pi));
    const Dent dent = bench.hit(bench.ball_over(0, 0, made.ball_radius), blow.work);
    made.depth = dent.depth, made.contact = dent.contact;
    made.line = mid_line(bench, blow.stations);
    for (uint32_t v = 0; v < bench.view().vertex_count(); ++v) made.mesh.positions.push_back(bench.place(v));
    for (uint32_t e = 0; e < bench.view().element_count(); ++e) made.mesh.triangles.push_back(bench.view().corners(e));
    return made;
}

}  // namespace cullet
