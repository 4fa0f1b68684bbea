// Numbers with their noise. Everything is measured in several passes, one after the other over all scenes, so that a
// busy quarter of an hour meets all alike; a figure is the middle of its passes, its noise how far they lie apart.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace cullet::perf {

/// One number and, where the project promises one, its limit.
struct Figure {
    std::string scene, name, unit;
    std::vector<double> values;        // one a pass
    double limit = 0;                  // 0: none
    bool is_least = false;             // the limit is the least allowed, not the most
    std::vector<double> ours, theirs;  // of a ratio: what it is of, in `parts_unit`; else empty
    std::string parts_unit;

    double value() const;
    /// 1.4826 x the median distance from the median (a standard deviation, if they were normal), in `unit`.
    double noise() const;
    /// A figure that is no number is missed.
    bool is_missed() const { return limit > 0 && !(is_least ? value() >= limit : value() <= limit); }
};

/// How it was measured, for who compares.
struct Origin {
    std::string processor, features;  // of the processor: its vector instructions
    unsigned hardware_threads = 0;
    std::string compiler, build, flags, commit, date;
    std::string simd = "best";  // level of the kernels that was asked for
    unsigned passes = 1;
};

/// Of this process. `commit` is what the sources were when they were configured.
Origin describe_origin();

/// All figures of one run of the program.
class Figures {
 public:
    void begin(const std::string& scene) { scene_ = scene; }
    void add(const std::string& name, double value, const std::string& unit, double limit = 0, bool is_least = false);
    /// Ours over theirs, with a limit that is the most; or theirs over ours, with one that is the least.
    void add_ratio(const std::string& name, double ours, double theirs, const std::string& parts_unit, double limit = 0,
                   bool is_least = false);
    const std::vector<Figure>& all() const { return all_; }
    /// Figures that miss their limit.
    uint32_t missed() const;
    /// One line a figure: ours, the yardstick, their ratio, the limit, the noise.
    void print() const;
    std::string json(const Origin& origin) const;

 private:
    Figure& figure(const std::string& name, const std::string& unit, double limit, bool is_least);
    std::string scene_;
    std::vector<Figure> all_;
};

double median(std::vector<double> values);

}  // namespace cullet::perf
