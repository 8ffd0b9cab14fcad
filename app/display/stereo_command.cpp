#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "app/display/display_commands.h"
#include "app/inputs/protocol_file.h"
#include "app/rig/open_display.h"
#include "experiment/base/error.h"
#include "render/image/ink_canvas.h"
#include "render/image/text_layout.h"
#include "render/presenter/stereo_presenter.h"
#include "render/signal/signal_decoder.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

/// Of the line by which the size of the pictures is measured with a ruler.
constexpr double ruled_mm = 50.0;
/// One press of an arrow: even, so that every output can carry it. With page up and down ten times as far.
constexpr int step_px = 2;

/// What an eye sees: a frame and a cross that both see, so that the eyes have something to hold on to; and
/// what one eye sees alone, the halves of an upright and of a level line. They meet where the pictures lie
/// on each other.
LinearImage alignment_picture(const ScreenGeometry& field, Eye eye, const std::string& words) {
    const glm::ivec2 size_px = field.image_px;
    InkCanvas canvas(size_px);
    const glm::dvec2 middle = 0.5 * glm::dvec2(size_px);
    const double px_per_deg = field.px_per_deg_at_centre();
    const double line_px = std::max(2.0, 0.05 * px_per_deg);
    const double reach = std::min({3.0 * px_per_deg, 0.3 * size_px.x, 0.3 * size_px.y});
    canvas.outline({middle.x - 1.2 * reach, middle.y - 1.2 * reach, 2.4 * reach, 2.4 * reach}, 0.7, line_px);
    const double cross = 0.08 * reach;
    canvas.line({middle.x - cross, middle.y}, {middle.x + cross, middle.y}, 1.0, line_px);
    canvas.line({middle.x, middle.y - cross}, {middle.x, middle.y + cross}, 1.0, line_px);
    const double side = eye == Eye::left ? -1.0 : 1.0;
    canvas.line({middle.x, middle.y + side * 0.2 * reach}, {middle.x, middle.y + side * reach}, 1.0, line_px);
    canvas.line({middle.x + side * 0.2 * reach, middle.y}, {middle.x + side * reach, middle.y}, 1.0, line_px);
    // To be measured where the screen is.
    const double ruled_px = ruled_mm * field.screen_px.x / field.screen_mm.x,
                 low = std::min(middle.y + 1.4 * reach, size_px.y - 0.25 * reach);
    if (ruled_px < size_px.x) {
        canvas.line({middle.x - 0.5 * ruled_px, low}, {middle.x + 0.5 * ruled_px, low}, 0.7, line_px);
        for (const double end : {-0.5, 0.5})
            canvas.line({middle.x + end * ruled_px, low - 2.0 * line_px},
                        {middle.x + end * ruled_px, low + 2.0 * line_px}, 0.7, line_px);
    }
    TextStyle style;
    style.line_height_px = std::max(12, static_cast<int>(std::min(0.35 * px_per_deg, 0.03 * size_px.y)));
    style.wrap_width_px = static_cast<int>(0.9 * size_px.x);
    const auto put = [&](const std::string& text, double x, double y) {
        const TextMeasure measured = measure_text(text, style);
        put_text(
            canvas, text, style,
            {static_cast<int>(x) - measured.size_px.x / 2, static_cast<int>(y) - measured.size_px.y / 2});
    };
    put(words, middle.x, std::max(middle.y - 1.55 * reach, 0.12 * size_px.y));
    put(fmt::format("{:g} mm", ruled_mm), middle.x,
        std::min(low + 1.2 * style.line_height_px, size_px.y - 0.6 * style.line_height_px));
    put(eye == Eye::left ? "L" : "R", middle.x + side * 0.6 * reach, middle.y + side * 0.6 * reach);
    return canvas.tinted(0.6f, 0.0f);
}

class AlignmentPictures final : public FrameSource {
  public:
    AlignmentPictures(const ScreenGeometry& field, std::string words) {
        for (const Eye eye : {Eye::left, Eye::right})
            pictures_.push_back(alignment_picture(field, eye, words));
    }
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0}; }
    LinearImage page(const Stimulus& of_eye, int) const override {
        return pictures_.at(static_cast<std::size_t>(of_eye.view));
    }
    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const override {
        Stimulus of_eye = placed.stimulus;
        of_eye.view = static_cast<int>(eye);
        return of_eye;
    }

  private:
    std::vector<LinearImage> pictures_;
};

/// The protocol's screen and eyes, with a field that is one picture, on an ordinary screen: the packed signal
/// of a Display++ would be unreadable while its box is not switched.
Protocol without_stimuli(const Protocol& protocol) {
    Protocol bare;
    bare.display = protocol.display;
    bare.display.output = OutputMode::native_8bit;
    bare.display.dither = Dithering::none;
    bare.display.characterisation.reset();
    bare.display.gamma = 2.2;
    bare.display.photodiode = PatchCorner::none;
    bare.display.onset_trigger = 0;
    bare.display.tags_px = 0;
    bare.stereo = protocol.stereo;
    const glm::ivec2 field_px = field_of(bare, Eye::left).size_px;
    bare.views.front().width_px = field_px.x;
    bare.views.front().height_px = field_px.y;
    return bare;
}

std::string words_on_fields(const StereoSettings& stereo) {
    if (stereo.kind != StereoKind::mirrors)
        return "escape: done";
    return fmt::format("arrows: nearer and farther apart, the left up and down; page up and down: faster\n"
                       "left {} {}   right {} {}   enter: done   escape: as before",
                       stereo.left_eye_right_px, stereo.left_eye_down_px, stereo.right_eye_right_px,
                       stereo.right_eye_down_px);
}

/// The lines that a protocol needs.
std::string keys_of_fields(const StereoSettings& stereo) {
    return fmt::format("[stereo]\nkind = \"{}\"\nleft_eye_right_px = {}\nleft_eye_down_px = {}\n"
                       "right_eye_right_px = {}\nright_eye_down_px = {}\n",
                       name_of(stereo.kind), stereo.left_eye_right_px, stereo.left_eye_down_px,
                       stereo.right_eye_right_px, stereo.right_eye_down_px);
}

/// Eyes apart: both pictures move, in opposite directions; the left one alone goes up and down.
void move_fields(StereoSettings& stereo, WindowKey key, int by_px) {
    const int apart = key == WindowKey::right ? by_px : key == WindowKey::left ? -by_px : 0;
    const int outwards = stereo.swapped ? -apart : apart;
    stereo.left_eye_right_px -= outwards;
    stereo.right_eye_right_px += outwards;
    stereo.left_eye_down_px += key == WindowKey::down ? by_px : key == WindowKey::up ? -by_px : 0;
}

void write_fields(StereoPresenter& presenter, const Protocol& protocol, const std::filesystem::path& file) {
    const glm::ivec2 size_px(protocol.display.width_px, protocol.display.height_px);
    const std::vector<std::byte> bytes = presenter.read_screen();
    const ReceivedLight light = receive_light({size_px, bytes}, protocol.display.output);
    LinearImage picture(size_px);
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const auto& level = light.at(x, y);
            glm::vec3 linear;
            for (int channel = 0; channel < 3; ++channel)
                linear[channel] = static_cast<float>(
                    std::pow(static_cast<double>(level[static_cast<std::size_t>(channel)]) / light.highest,
                             protocol.display.gamma));
            picture.at(x, y) = glm::vec4(linear, 1.0f);
        }
    write_srgb_png(file, picture);
}

} // namespace

int run_display_stereo(const DisplayStereoOptions& options) {
    Protocol protocol = read_protocol_or_report(options.protocol);
    if (!protocol.stereo.is_on())
        throw InputError(fmt::format("{}: both eyes see the same: write [stereo] with kind = \"mirrors\"",
                                     options.protocol.string()));
    const bool in_window = options.picture.empty();
    if (in_window && !display_is_available())
        throw InputError("there is no display to show this on: write it with --picture FILE instead");
    const Protocol before = without_stimuli(protocol);
    Protocol shown = before;
    OpenDisplay display({.context = in_window ? ContextChoice(ContextKind::window) : std::nullopt,
                         .size_px = {shown.display.width_px, shown.display.height_px},
                         .title = "overt display stereo",
                         .refresh_hz = shown.display.refresh_hz,
                         .virtual_time = !in_window,
                         .windowed = options.windowed,
                         .monitor = options.monitor.empty() ? shown.display.monitor : options.monitor,
                         .headless = !in_window,
                         .has_two_eyes = shown.stereo.kind == StereoKind::frame_sequential});
    display.start();
    bool is_done = false;
    while (!is_done) {
        const AlignmentPictures pictures(screen_geometry_of(shown), words_on_fields(shown.stereo));
        StereoPresenter presenter(display.context(), display.surface(), pictures, shown);
        presenter.load_frames({});
        presenter.flip({0});
        if (!in_window) {
            write_fields(presenter, shown, options.picture);
            fmt::print("{}\n", options.picture.string());
            return 0;
        }
        // Shown until a key has moved something.
        for (bool is_moved = false; !is_moved && !is_done;) {
            presenter.flip({0});
            for (WindowKeyPress press{}; display.window()->next_key_press(press);) {
                switch (press.key) {
                case WindowKey::left:
                case WindowKey::right:
                case WindowKey::up:
                case WindowKey::down:
                    move_fields(shown.stereo, press.key, step_px);
                    is_moved = true;
                    break;
                case WindowKey::page_up:
                case WindowKey::page_down:
                    move_fields(shown.stereo,
                                press.key == WindowKey::page_up ? WindowKey::right : WindowKey::left,
                                10 * step_px);
                    is_moved = true;
                    break;
                case WindowKey::escape:
                    shown.stereo = before.stereo;
                    is_done = true;
                    break;
                case WindowKey::enter:
                    is_done = true;
                    break;
                default:
                    break;
                }
            }
            is_done = is_done || presenter.closed();
        }
    }
    fmt::print("{}", keys_of_fields(shown.stereo));
    return 0;
}

} // namespace overt
