// What a published work says and what this program does: one row of the page that sample_game reproduce writes.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace cullet::reproduce {

enum class Verdict : uint8_t {
    Met,          // the number is as good as the published one, or better
    FallsShort,   // it is not
    Shown,        // a picture, judged by eye
    NotMeasured,  // left out of this run
};
const char* name_of(Verdict verdict);

/// One measured number, beside the published one where there is one.
struct Number {
    std::string name, unit;
    double ours = 0;
    std::optional<double> paper;
};

/// Cells as they are printed; the first row heads the columns.
struct Table {
    std::string title;
    std::vector<std::vector<std::string>> rows;
};

struct PictureFile {
    std::string file, caption;  // file: relative to the page
};

struct Claim {
    std::string id;     // "table_1": names its pictures, stands in report.json
    std::string where;  // "Table 1", "Figure 3", "section 3.2.3"
    std::string title;
    std::string paper, ours;  // a sentence or two each
    Verdict verdict = Verdict::NotMeasured;
    std::vector<Number> numbers;
    std::vector<Table> tables;
    std::vector<PictureFile> pictures;
    double seconds = 0;  // that it took
};

}  // namespace cullet::reproduce
