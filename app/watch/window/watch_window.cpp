#include "app/watch/window/watch_window.h"

#include <chrono>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/watch/live_saliency.h"
#include "app/watch/watched_session.h"
#include "app/watch/window/imgui_window.h"
#include "app/watch/window/saliency_picture.h"
#include "app/watch/window/watch_panels.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int first_width = 1280, first_height = 800;
/// A view need not be as fast as a display; where the processor draws it, it leaves the processor to the
/// session.
constexpr std::chrono::milliseconds between_frames{8}, between_drawn_frames{33};
/// For the next point of gaze, which comes every 4 ms.
constexpr std::chrono::milliseconds longest_wait{6};
/// As the views are told points of one eye.
constexpr double seconds_of_point = 0.004;

/// Four bytes a pixel as a texture, renewed when they change.
class PixelTexture {
  public:
    explicit PixelTexture(const GlContext& context) : context_(context) {}

    /// Null for no pixels. `rgba`: red in the lowest byte.
    GLuint of(int width, int height, std::vector<std::byte> rgba) {
        if (rgba.empty())
            return 0;
        if (!texture_ || texture_->size_px() != glm::ivec2(width, height) || rgba != shown_) {
            texture_.emplace(context_, glm::ivec2(width, height), PixelFormat::rgba8);
            texture_->set_linear_filter_wrapped();
            texture_->upload(rgba);
            shown_ = std::move(rgba);
        }
        return texture_->name();
    }

  private:
    const GlContext& context_;
    std::optional<Texture2D> texture_;
    std::vector<std::byte> shown_;
};

std::vector<std::byte> rgba_of(const ViewedPicture& picture) {
    std::vector<std::byte> rgba;
    rgba.reserve(4 * picture.lightness.size());
    for (const float light : picture.lightness) {
        const auto grey = static_cast<std::byte>(255.0f * light + 0.5f);
        rgba.insert(rgba.end(), {grey, grey, grey, std::byte{255}});
    }
    return rgba;
}

std::vector<std::byte> rgba_of(const ViewedCamera& camera) {
    std::vector<std::byte> rgba;
    for (std::size_t i = 0; i + 2 < camera.rgb.size(); i += 3)
        rgba.insert(rgba.end(), {camera.rgb[i], camera.rgb[i + 1], camera.rgb[i + 2], std::byte{255}});
    return rgba;
}

double steady_now_s() { return std::chrono::duration<double>(SteadyClock::now().time_since_epoch()).count(); }

/// When each point that is shown came to stand in the window.
class ShownTimes {
  public:
    explicit ShownTimes(bool are_kept) : are_kept_(are_kept) {}

    /// The newest point that the frame just drawn has.
    void shown(const ViewedGaze& gaze, std::optional<double> clock_zero_s, bool has_surface) {
        if (gaze.at_s == last_at_s_)
            return;
        last_at_s_ = gaze.at_s;
        const double now_s = steady_now_s();
        if (clock_zero_s) {
            delays_s_[next_++ % delays_s_.size()] = now_s - *clock_zero_s - gaze.at_s;
            count_ = std::min(next_, delays_s_.size());
        }
        if (are_kept_)
            rows_ += fmt::format("{}\t{:.6f}\t{}\n", gaze.sampled_us, now_s, has_surface ? 1 : 0);
    }
    /// Of the last points, in the middle; nothing before there are some.
    std::optional<double> median_delay_s() const {
        if (count_ < 10)
            return std::nullopt;
        std::array<double, 64> sorted = delays_s_;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
        std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count_));
        return *middle;
    }
    const std::string& rows() const { return rows_; }

  private:
    bool are_kept_;
    double last_at_s_ = -1.0;
    std::array<double, 64> delays_s_{};
    std::size_t next_ = 0, count_ = 0;
    std::string rows_;
};

} // namespace

int watch_in_window(const std::filesystem::path& socket, const std::filesystem::path& times) {
    const Interruption interruption;
    OperatorClient client(socket);
    WatchedSession session(client);
    LiveSaliency saliency;
    ImguiWindow window(first_width, first_height, "overt: the operator's view");
    PixelTexture camera(window);
    std::vector<std::unique_ptr<PixelTexture>> stimuli; // by what is shown
    SaliencyPicture surface(window);
    MarkPen pen(window);
    WatchPanels panels(client, saliency, surface);
    ShownTimes shown(!times.empty());
    const auto between = window.description().is_software ? between_drawn_frames : between_frames;
    std::pair<std::shared_ptr<const WatchedObject>, std::string> prepared;
    bool has_right = false; // of both eyes one is enough: their gaze would be counted twice
    SteadyClock::time_point due{};
    while (!window.is_closed() && !Interruption::requested()) {
        const auto take = [&](std::chrono::milliseconds wait) {
            session.read(wait);
            for (const GazeOnSurface& one : session.new_gaze()) {
                has_right = has_right || one.gaze.is_right;
                if (one.hit && one.gaze.is_right == has_right)
                    saliency.looked(session.object_of(one.gaze.shown), session.slot_of(one.gaze.shown),
                                    one.gaze.trial, *one.hit, seconds_of_point);
            }
            return !session.new_gaze().empty();
        };
        while (SteadyClock::now() < due)
            take(std::chrono::milliseconds(1));
        due = SteadyClock::now() + between;
        if (const std::pair now{session.object(), session.slot_of(session.looked_at())};
            now.first && now != prepared) {
            prepared = now;
            saliency.prepare(prepared.first, prepared.second);
        }
        const ViewText text = session.text();
        WatchPictures pictures;
        if (session.camera())
            pictures.camera = camera.of(session.camera()->width_px, session.camera()->height_px,
                                        rgba_of(*session.camera()));
        else
            for (const ViewedPicture& one : session.pictures()) {
                if (pictures.stimuli.size() == stimuli.size())
                    stimuli.push_back(std::make_unique<PixelTexture>(window));
                PixelTexture& texture = *stimuli[pictures.stimuli.size()];
                pictures.stimuli.push_back(texture.of(one.width, one.height, rgba_of(one)));
            }
        window.draw([&](float width, float height) {
            panels.draw(text, session, pictures, shown.median_delay_s(), width, height);
        });
        // All but gaze stands. Gaze is drawn over it when the next point comes, so that it is new when it is
        // shown: what came while the frame was drawn is not.
        take(std::chrono::milliseconds(0));
        for (const auto latest = SteadyClock::now() + longest_wait;
             session.last_gaze() && !take(std::chrono::milliseconds(1)) && SteadyClock::now() < latest;) {
        }
        window.show([&](glm::ivec2 window_px) { pen.draw(panels.marks(session), window_px); });
        if (session.last_gaze())
            shown.shown(session.last_gaze()->gaze, client.facts().clock_zero_s,
                        session.last_gaze()->hit.has_value());
    }
    if (!times.empty()) {
        std::ofstream file(times);
        file << "sampled_us\tshown_s\thas_surface\n" << shown.rows();
        if (!file.flush())
            throw InputError(fmt::format("{}: cannot be written", times.string()));
    }
    return 0;
}

} // namespace overt
