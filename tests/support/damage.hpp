// Files that are cut off or damaged, for readers that must end every one of them with a mesh or one sentence.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "cullet/result.hpp"

namespace cullet::test {

/// Begins with the file, ends with a full stop, is one line.
inline bool is_a_sentence(const std::string& text, const std::string& file) {
    return text.rfind(file + ": ", 0) == 0 && text.back() == '.' && text.find('\n') == text.npos;
}

/// The file, every beginning of it (of long ones 1,000), and so many with one to four places changed.
inline void for_damaged(const std::string& bytes, int changed, const std::function<void(const std::string&)>& call) {
    const size_t step = bytes.size() / 1000 + 1;
    for (size_t size = 0; size <= bytes.size(); size += step) call(bytes.substr(0, size));
    std::mt19937 random(7);
    const auto below = [&random](size_t n) { return static_cast<size_t>(random()) % n; };
    for (int i = 0; i < changed; ++i) {
        std::string other = bytes;
        for (size_t places = 1 + below(4); places > 0 && !other.empty(); --places) {
            const size_t at = below(i % 2 == 0 ? std::min<size_t>(other.size(), 400) : other.size());
            switch (below(4)) {
                case 0:
                    other[at] = static_cast<char>(below(256));
                    break;
                case 1:
                    other[at] = "0123456789-+.eE \n"[below(17)];
                    break;
                case 2:
                    other.erase(at, 1 + below(8));
                    break;
                default:
                    other.insert(at, other.substr(below(other.size()), below(16)));
            }
        }
        call(other);
    }
}

/// `read` gives a Result of anything.
template <class Read>
void expect_meshes_or_sentences(const std::string& bytes, const std::string& file, int changed, const Read& read) {
    for_damaged(bytes, changed, [&](const std::string& damaged) {
        const auto result = read(damaged);
        EXPECT_TRUE(result.ok() || is_a_sentence(result.error(), file)) << result.error();
    });
}

}  // namespace cullet::test
