#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/pictures/picture_file.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"

namespace overt {

namespace {

constexpr int frame_files = 61;
constexpr int rounds = 3;

/// What a frame of an object is to a decoder: a smooth figure with a little noise on an empty background.
std::vector<float> figure_rgba(int size_px, int frame) {
    RandomStream random(1, "frames", static_cast<std::uint64_t>(frame));
    std::vector<float> pixels(4 * static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px));
    auto pixel = pixels.begin();
    for (int y = 0; y < size_px; ++y) {
        for (int x = 0; x < size_px; ++x, pixel += 4) {
            const double u = (2.0 * x - size_px) / (0.7 * size_px),
                         v = (2.0 * y - size_px) / (0.95 * size_px);
            if (u * u + v * v > 1.0)
                continue;
            const double light =
                0.5 + 0.4 * std::sin(9.0 * u + 0.1 * frame) * std::cos(7.0 * v) + 0.02 * random.uniform();
            pixel[0] = static_cast<float>(light);
            pixel[1] = static_cast<float>(0.75 * light);
            pixel[2] = static_cast<float>(0.4 * light);
            pixel[3] = 1.0f;
        }
    }
    return pixels;
}

struct FileKind {
    const char* name;
    const char* extension;
    const char* compression; ///< of EXR
    PixelType type;
    std::size_t value_bytes;
    FrameEncoding encoding;
};

const FileKind kinds[] = {{"24-bit EXR", "exr", "pxr24", PixelType::float32, 4, FrameEncoding::linear},
                          {"half-float EXR", "exr", "zip", PixelType::float16, 2, FrameEncoding::linear},
                          {"16-bit PNG", "png", "zip", PixelType::bits16, 2, FrameEncoding::srgb}};

std::filesystem::path file_of(const std::filesystem::path& folder, const FileKind& kind, int frame) {
    return folder / fmt::format("frame_{:04}.{}", frame, kind.extension);
}

void write_frames(const std::filesystem::path& folder, const FileKind& kind, int size_px) {
    parallel_for(frame_files, [&](int frame) {
        const PictureHeader header{
            glm::ivec2(size_px), {"R", "G", "B", "A"}, kind.type, 3, {{"compression", kind.compression}}};
        write_picture(file_of(folder, kind, frame), header, PixelType::float32,
                      figure_rgba(size_px, frame).data());
    });
}

/// As the file has its values, without a conversion, one file a thread.
void read_by_library_alone(const std::filesystem::path& folder, const FileKind& kind) {
    parallel_for(frame_files, [&](int frame) {
        thread_local std::vector<char> pixels;
        PictureFile picture(file_of(folder, kind, frame), "picture");
        const PictureHeader& header = picture.header();
        pixels.resize(kind.value_bytes * header.channels.size() *
                      static_cast<std::size_t>(header.size_px.x * header.size_px.y));
        picture.read(header.channel_count(), PixelType::other, pixels.data());
    });
}

/// The files as a stimulus.
class FilesOnDisk final : public FrameSource {
  public:
    FilesOnDisk(std::filesystem::path folder, const FileKind& kind)
        : folder_(std::move(folder)), kind_(kind) {}
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(frame_files);
        std::iota(pages.begin(), pages.end(), 0);
        return pages;
    }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        LinearImage image;
        read_page(stimulus, page, image);
        return image;
    }
    const LinearImage& read_page(const Stimulus&, int page, LinearImage& room) const override {
        read_linear_image(file_of(folder_, kind_, page), kind_.encoding, FileColours::as_they_stand, room);
        return room;
    }

  private:
    std::filesystem::path folder_;
    FileKind kind_;
};

/// As the frame store has it done: all values as floats, checked, without an encoding, premultiplied.
void decode(const FrameSource& files) {
    parallel_for(frame_files, [&](int frame) {
        thread_local LinearImage picture;
        files.read_page({0, 0}, frame, picture);
    });
}

/// Shown as fast as they come, the files being in memory.
double streamed_hz(const GlContext& context, const FilesOnDisk& files, const ScreenGeometry& geometry) {
    VirtualClock clock;
    VirtualDisplay surface(context, clock, 120.0);
    DisplaySettings display;
    display.frame_store_mb =
        1.001e-6 * least_streamed_pages * 4.0 * geometry.image_px.x * geometry.image_px.y;
    PagePresenter presenter(context, surface, files, geometry, display, {});
    presenter.load_frames({0, 0});
    // Those that were there from the start are no work.
    return (frame_files - least_streamed_pages) / seconds_for([&] {
               for (int frame = 0; frame < frame_files; ++frame)
                   presenter.flip({frame});
           });
}

void measure_kind(const GlContext& context, const FileKind& kind, int size_px, BenchFigures& figures) {
    const ScratchFolder folder("overt-bench-frames");
    write_frames(folder.path(), kind, size_px);
    ScreenGeometry geometry;
    geometry.image_px = glm::ivec2(size_px);
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    const FilesOnDisk files(folder.path(), kind);
    std::vector<double> library_s, decoding_s, loading_s;
    for (int round = 0; round < rounds; ++round) {
        library_s.push_back(seconds_for([&] { read_by_library_alone(folder.path(), kind); }));
        decoding_s.push_back(seconds_for([&] { decode(files); }));
        VirtualClock clock;
        VirtualDisplay surface(context, clock, 120.0);
        PagePresenter presenter(context, surface, files, geometry, DisplaySettings{}, {});
        loading_s.push_back(seconds_for([&] { presenter.load_frames({0, 0}); }));
    }
    const auto best = [](const std::vector<double>& times) { return *std::ranges::min_element(times); };
    const std::string what = fmt::format("61 frames, {}", kind.name);
    figures.push_back({what + ", read by its library alone", best(library_s), "s"});
    figures.push_back({what + ", decoded to linear light", best(decoding_s), "s"});
    figures.push_back(at_most(what + ", ratio of the two", best(decoding_s) / best(library_s), "", 1.5));
    figures.push_back({what + ", decoded, packed for Color++ and uploaded", best(loading_s), "s"});
    figures.push_back({what + ", pictures a second while they are shown, with room for 8",
                       streamed_hz(context, files, geometry), "1/s"});
}

} // namespace

BenchFigures bench_frames(const BenchOptions& options) {
    const std::unique_ptr<GlContext> context = make_headless_context(options.context);
    BenchFigures figures;
    for (const FileKind& kind : kinds)
        measure_kind(*context, kind, std::min(options.size_px, 1024), figures);
    return figures;
}

} // namespace overt
