// How far long work has come: a bar on a terminal, a line every few seconds elsewhere. Goes to standard error.
#pragma once
#include <cstdint>
#include <string>

namespace cullet {

class Progress {
 public:
    explicit Progress(std::string title);
    /// Ends the bar's line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `share` from 0 to 1; `detail` stands behind it.
    void show(double share, const std::string& detail = "");
    /// For cook(): `user` is a Progress.
    static void cooked(void* user, float share);

 private:
    std::string title_;
    bool is_terminal_;
    bool has_bar_ = false;
    uint64_t started_ns_, shown_ns_;
};

}  // namespace cullet
