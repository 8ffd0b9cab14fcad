#include "app/replay/movie_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "render/image/stored_values.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

bool is_on_path(const std::string& program) {
    const char* const variable = std::getenv("PATH");
    const std::string path = variable ? variable : "";
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t colon = std::min(path.find(':', at), path.size());
        if (colon > at && ::access((path.substr(at, colon - at) + "/" + program).c_str(), X_OK) == 0)
            return true;
        at = colon + 1;
    }
    return false;
}

std::uint8_t code_of(float light) {
    return static_cast<std::uint8_t>(std::lround(255.0f * srgb_from_linear(std::clamp(light, 0.0f, 1.0f))));
}

} // namespace

void MovieFile::require_ffmpeg() {
    if (!is_on_path("ffmpeg"))
        throw Error("the program ffmpeg, which makes movies, is not installed: install it (apt-get install "
                    "ffmpeg), or draw single frames with --frame K --picture FILE");
}

MovieFile::MovieFile(const fs::path& file, glm::ivec2 size_px, double rate_hz, bool overwrite)
    : file_(file), partial_(file.parent_path() / (".partial-" + file.filename().string())),
      said_(partial_.string() + ".txt"), size_px_(size_px),
      bytes_(std::size_t{3} * static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y)) {
    require_ffmpeg();
    if (!overwrite && fs::exists(file))
        throw InputError(
            fmt::format("{}: this file is there already: name another, or give --overwrite", file.string()));
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        throw Error("no pipe to ffmpeg can be made: close other programs");
    pipe_ = ends[1];
    std::vector<std::string> words{
        "ffmpeg", "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgb24",
        "-video_size", fmt::format("{}x{}", size_px.x, size_px.y), "-framerate",
        fmt::format("{:.6f}", rate_hz), "-i", "pipe:0",
        // Most players want halved colours, and those an even size.
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-y", partial_.string()};
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    for (const int output : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, output, said_.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                         0600);
    const int error = ::posix_spawnp(&process_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    if (error != 0) {
        process_ = -1;
        fail();
    }
}

MovieFile::~MovieFile() {
    if (pipe_ >= 0)
        ::close(pipe_);
    if (process_ > 0) {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    std::error_code ignored;
    fs::remove(partial_, ignored);
    fs::remove(said_, ignored);
}

void MovieFile::fail() {
    int unused = 0;
    const std::string said = read_whole_file(said_, most_text_bytes, unused).value_or("");
    throw Error(fmt::format("{}: ffmpeg did not make the movie{}{}", file_.string(),
                            said.empty() ? "" : ", and said:\n", said));
}

void MovieFile::add(const LinearImage& frame) {
    OVERT_EXPECTS(frame.size_px == size_px_);
    std::size_t at = 0;
    for (const glm::vec4& pixel : frame.pixels)
        for (int channel = 0; channel < 3; ++channel)
            bytes_[at++] = code_of(pixel[channel]);
    for (std::size_t written = 0; written < bytes_.size();) {
        const ssize_t now = ::write(pipe_, bytes_.data() + written, bytes_.size() - written);
        if (now > 0)
            written += static_cast<std::size_t>(now);
        else if (errno != EINTR)
            fail();
    }
}

void MovieFile::finish() {
    ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    std::error_code error;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !fs::exists(partial_))
        fail();
    fs::rename(partial_, file_, error);
    if (error)
        throw Error(fmt::format("{}: cannot be written: {}", file_.string(), error.message()));
}

} // namespace overt
