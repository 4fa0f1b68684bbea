// Pictures as a film: raw frames to the program ffmpeg, which writes H.264.
#pragma once
#include <sys/types.h>

#include <string>

#include "cullet/result.hpp"
#include "sample_game/png.hpp"

namespace cullet {

/// A sentence when ffmpeg is not in PATH.
Result<void> look_for_ffmpeg();

class Film {
 public:
    Film() = default;
    /// Waits for ffmpeg when finish() was not called.
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Starts ffmpeg on the first picture; all have its size.
    Result<void> add(const Picture& picture, const std::string& path, double frames_a_second);
    /// Returns when the file is whole.
    Result<void> finish();

 private:
    Result<void> start(const Picture& picture, const std::string& path, double frames_a_second);
    int end();

    int input_ = -1;  // a socket and not a pipe: writing to one that nobody reads any more raises no signal
    pid_t program_ = -1;
};

}  // namespace cullet
