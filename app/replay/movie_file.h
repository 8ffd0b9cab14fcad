/// A movie, written by the program ffmpeg.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <sys/types.h>

#include "render/image/linear_image.h"

namespace overt {

/// Frames go to ffmpeg through a pipe as 8-bit sRGB; it makes of them what the name's ending says.
class MovieFile {
  public:
    /// Starts ffmpeg. Throws Error that says how to install it if it is not found, InputError for a file that
    /// exists unless it may be replaced.
    MovieFile(const std::filesystem::path& file, glm::ivec2 size_px, double rate_hz, bool overwrite);
    /// Without finish() ffmpeg is ended, and nothing is left of the movie.
    ~MovieFile();
    MovieFile(const MovieFile&) = delete;
    MovieFile& operator=(const MovieFile&) = delete;

    /// Linear light, clipped to 0 … 1; of the size that was given. Throws Error with what ffmpeg said.
    void add(const LinearImage& frame);
    /// Waits for ffmpeg to end. Throws likewise.
    void finish();

    /// Whether there is such a program. Throws Error that says how to install it if not.
    static void require_ffmpeg();

  private:
    [[noreturn]] void fail();
    std::filesystem::path file_, partial_, said_;
    glm::ivec2 size_px_;
    pid_t process_ = -1;
    int pipe_ = -1;
    std::vector<std::uint8_t> bytes_;
};

} // namespace overt
