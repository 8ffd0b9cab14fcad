#include "devices/eyelink/eyelink_setup.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"

namespace overt {
namespace {

constexpr int largest_image_px = 4096;

/// Codes of keys that are no characters.
constexpr std::uint16_t escape_key = 0x1B, terminate_key = 0x7FFF;

/// Whom the hooks of both forms work for; null: nobody. What the library keeps of the hooks outlives each
/// set-up, so it never gets the address of one.
EyelinkSetup* active_setup = nullptr;

std::string utf8_of(const char* text) {
    const std::string_view bytes = text ? text : "";
    return is_utf8(bytes) ? std::string(bytes) : utf8_of_latin1(bytes);
}

/// What a hook does for the set-up that is under way; without one, nothing.
template <class Call> std::int16_t in_setup(const Call& call) {
    return active_setup ? call(*active_setup) : std::int16_t{0};
}

extern "C" {
std::int16_t overt_el1_set_up() {
    return in_setup([](EyelinkSetup& setup) { return setup.set_up(); });
}
void overt_el1_clear() {
    in_setup([](EyelinkSetup& setup) { return setup.clear(); });
}
void overt_el1_nothing() {}
std::int16_t overt_el1_set_up_image(std::int16_t, std::int16_t) { return 0; }
void overt_el1_image_title(std::int16_t threshold, char* name) {
    in_setup([&](EyelinkSetup& setup) {
        return setup.image_title(threshold < 0 ? utf8_of(name)
                                               : fmt::format("{}, threshold {}", utf8_of(name), threshold));
    });
}
void overt_el1_image_line(std::int16_t width, std::int16_t line, std::int16_t lines, std::uint8_t* indices) {
    in_setup([&](EyelinkSetup& setup) { return setup.image_line(width, line, lines, indices); });
}
void overt_el1_palette(std::int16_t colours, std::uint8_t* red, std::uint8_t* green, std::uint8_t* blue) {
    const auto count = static_cast<std::size_t>(std::max<std::int16_t>(colours, 0));
    in_setup([&](EyelinkSetup& setup) {
        return setup.image_palette({red, count}, {green, count}, {blue, count});
    });
}
void overt_el1_draw_target(std::int16_t x, std::int16_t y) {
    in_setup([&](EyelinkSetup& setup) { return setup.draw_target(x, y); });
}
std::int16_t overt_el2_beep(void*, std::int32_t which) {
    return in_setup([&](EyelinkSetup& setup) { return setup.beep(which); });
}
void overt_el1_target_beep() { overt_el2_beep(nullptr, 1); }
void overt_el1_calibration_beep(std::int16_t error) { overt_el2_beep(nullptr, error ? -1 : 0); }
void overt_el1_drift_beep(std::int16_t error) { overt_el2_beep(nullptr, error ? -2 : 2); }
void overt_el1_drift_target_beep() { overt_el2_beep(nullptr, 3); }
std::int16_t overt_el1_input_key(void* event) {
    return in_setup([&](EyelinkSetup& setup) { return setup.input_key(event); });
}
void overt_el1_alert(const char* text) {
    in_setup([&](EyelinkSetup& setup) { return setup.alert(utf8_of(text)); });
}

std::int16_t overt_el2_set_up(void*) { return overt_el1_set_up(); }
std::int16_t overt_el2_clear(void*) {
    return in_setup([](EyelinkSetup& setup) { return setup.clear(); });
}
std::int16_t overt_el2_set_up_image(void*, std::int16_t, std::int16_t) { return 0; }
std::int16_t overt_el2_image_title(void*, char* title) {
    return in_setup([&](EyelinkSetup& setup) { return setup.image_title(utf8_of(title)); });
}
std::int16_t overt_el2_image(void*, std::int16_t width, std::int16_t height, std::uint8_t* rgba) {
    return in_setup([&](EyelinkSetup& setup) { return setup.image(width, height, rgba); });
}
std::int16_t overt_el2_draw_target(void*, float x, float y) {
    return in_setup([&](EyelinkSetup& setup) { return setup.draw_target(x, y); });
}
std::int16_t overt_el2_input_key(void*, void* event) { return overt_el1_input_key(event); }
std::int16_t overt_el2_alert(void*, const char* text) {
    return in_setup([&](EyelinkSetup& setup) { return setup.alert(utf8_of(text)); });
}
}

EyelinkHooks hooks_of_first_form{.set_up = overt_el1_set_up,
                                 .leave = overt_el1_clear,
                                 .recording_broken_off = overt_el1_nothing,
                                 .set_up_image = overt_el1_set_up_image,
                                 .image_title = overt_el1_image_title,
                                 .image_line = overt_el1_image_line,
                                 .image_palette = overt_el1_palette,
                                 .leave_image = overt_el1_clear,
                                 .clear = overt_el1_clear,
                                 .erase_target = overt_el1_clear,
                                 .draw_target = overt_el1_draw_target,
                                 .target_beep = overt_el1_target_beep,
                                 .calibration_beep = overt_el1_calibration_beep,
                                 .drift_beep = overt_el1_drift_beep,
                                 .drift_target_beep = overt_el1_drift_target_beep,
                                 .input_key = overt_el1_input_key,
                                 .alert = overt_el1_alert};

EyelinkHooks2 hooks_of_second_form{.major = 1,
                                   .minor = 0,
                                   .user = nullptr,
                                   .set_up = overt_el2_set_up,
                                   .leave = overt_el2_clear,
                                   .set_up_image = overt_el2_set_up_image,
                                   .image_title = overt_el2_image_title,
                                   .image = overt_el2_image,
                                   .leave_image = overt_el2_clear,
                                   .clear = overt_el2_clear,
                                   .erase_target = overt_el2_clear,
                                   .draw_target = overt_el2_draw_target,
                                   .beep = overt_el2_beep,
                                   .input_key = overt_el2_input_key,
                                   .alert = overt_el2_alert,
                                   .reserved = {}};

} // namespace

std::uint16_t eyelink_key(const SetupKey& key) noexcept {
    using Kind = SetupKey::Kind;
    constexpr std::pair<Kind, std::uint16_t> codes[] = {
        {Kind::enter, 0x0D},   {Kind::escape, escape_key}, {Kind::space, 0x20},      {Kind::backspace, 0x08},
        {Kind::tab, 0x09},     {Kind::up, 0x4800},         {Kind::down, 0x5000},     {Kind::left, 0x4B00},
        {Kind::right, 0x4D00}, {Kind::page_up, 0x4900},    {Kind::page_down, 0x5100}};
    if (key.kind == Kind::character)
        return key.character < 0x80 ? static_cast<std::uint16_t>(key.character) : std::uint16_t{0};
    if (key.kind == Kind::function)
        return key.character >= 1 && key.character <= 10
                   ? static_cast<std::uint16_t>(0x3B00 + ((key.character - 1) << 8))
                   : std::uint16_t{0};
    const auto* const known = std::ranges::find(codes, key.kind, &std::pair<Kind, std::uint16_t>::first);
    return known == std::end(codes) ? std::uint16_t{0} : known->second;
}

EyelinkSetup::EyelinkSetup(const EyelinkLibrary& library, SetupScreen* setup_screen, Degrees target,
                           const Clock& clock, SessionTime until)
    : library_(&library), setup_screen_(setup_screen), target_(target), clock_(&clock), until_(until) {
    OVERT_EXPECTS(!active_setup);
    active_setup = this;
    const EyelinkFunctions& of = *library;
    if (!of.setup_graphic_hook_functions_V2 || of.setup_graphic_hook_functions_V2(&hooks_of_second_form) != 0)
        of.setup_graphic_hook_functions(&hooks_of_first_form);
}

EyelinkSetup::~EyelinkSetup() { active_setup = nullptr; }

void EyelinkSetup::check() const {
    if (thrown_)
        std::rethrow_exception(thrown_);
    if (is_connection_lost_)
        throw DeviceError(
            "The connection to the EyeLink was lost during its set-up. Look at the network cable and "
            "at the host.");
}

template <class Work> std::int16_t EyelinkSetup::guarded(const Work& work) noexcept {
    if (thrown_)
        return -1;
    try {
        if (setup_screen_)
            work();
        return 0;
    } catch (...) {
        thrown_ = std::current_exception();
        return -1;
    }
}

void EyelinkSetup::end_dialogue() noexcept { (*library_)->exit_calibration(); }

std::int16_t EyelinkSetup::set_up() noexcept {
    return guarded([&] {
        setup_screen_->show_text("Set-up of the EyeLink. Enter: camera image. C: calibrate. V: validate. "
                                 "Esc: back, and at last to the experiment.");
    });
}

std::int16_t EyelinkSetup::clear() noexcept {
    return guarded([&] { setup_screen_->clear(); });
}

std::int16_t EyelinkSetup::draw_target(double x_px, double y_px) noexcept {
    return guarded([&] { setup_screen_->show_target({x_px, y_px}, target_); });
}

std::int16_t EyelinkSetup::beep(int which) noexcept {
    return guarded([&] {
        switch (which) {
        case -2:
            return setup_screen_->beep(Beep::drift_bad);
        case -1:
            return setup_screen_->beep(Beep::calibration_bad);
        case 0:
            return setup_screen_->beep(Beep::calibration_good);
        case 2:
            return setup_screen_->beep(Beep::drift_good);
        default:
            return setup_screen_->beep(Beep::target_appears);
        }
    });
}

std::int16_t EyelinkSetup::image_title(std::string title) noexcept {
    return guarded([&] { camera_.title = std::move(title); });
}

std::int16_t EyelinkSetup::image_palette(std::span<const std::uint8_t> red,
                                         std::span<const std::uint8_t> green,
                                         std::span<const std::uint8_t> blue) noexcept {
    return guarded([&] {
        palette_.clear();
        for (std::size_t i = 0; i < red.size(); ++i)
            for (const std::uint8_t value : {red[i], green[i], blue[i], std::uint8_t{255}})
                palette_.push_back(std::byte{value});
    });
}

std::int16_t EyelinkSetup::image_line(int width, int line, int lines, const std::uint8_t* indices) noexcept {
    return guarded([&] {
        if (!indices || width < 1 || lines < 1 || width > largest_image_px || lines > largest_image_px ||
            line < 1 || line > lines)
            return;
        if (camera_.width_px != width || camera_.height_px != lines) {
            camera_.width_px = width;
            camera_.height_px = lines;
            camera_.rgba.assign(4u * static_cast<std::size_t>(width) * static_cast<std::size_t>(lines),
                                std::byte{0});
        }
        std::byte* to =
            camera_.rgba.data() + 4u * static_cast<std::size_t>(width) * static_cast<std::size_t>(line - 1);
        for (int x = 0; x < width; ++x, to += 4)
            if (const std::size_t colour = 4u * indices[x]; colour + 4 <= palette_.size())
                std::memcpy(to, palette_.data() + colour, 4);
        if (line == lines)
            setup_screen_->show_camera(camera_);
    });
}

std::int16_t EyelinkSetup::image(int width, int height, const std::uint8_t* rgba) noexcept {
    return guarded([&] {
        if (!rgba || width < 1 || height < 1 || width > largest_image_px || height > largest_image_px)
            return;
        camera_.width_px = width;
        camera_.height_px = height;
        const auto* bytes = reinterpret_cast<const std::byte*>(rgba);
        camera_.rgba.assign(bytes, bytes + 4 * std::ptrdiff_t{width} * height);
        setup_screen_->show_camera(camera_);
    });
}

std::int16_t EyelinkSetup::alert(std::string text) noexcept {
    return guarded([&] { setup_screen_->show_text(text); });
}

std::int16_t EyelinkSetup::input_key(void* event) noexcept {
    std::optional<SetupKey> key;
    guarded([&] {
        key = setup_screen_->next_key();
        if (!key)
            setup_screen_->wait(std::chrono::milliseconds(2)); // the library asks again and again
    });
    is_out_of_time_ = is_out_of_time_ || clock_->now() >= until_;
    is_connection_lost_ = is_connection_lost_ || (*library_)->eyelink_is_connected() == 0;
    const bool ends =
        thrown_ || is_out_of_time_ || is_connection_lost_ || (setup_screen_ && setup_screen_->is_cancelled());
    const std::uint16_t code = ends  ? (setup_screen_ ? terminate_key : escape_key)
                               : key ? eyelink_key(*key)
                                     : std::uint16_t{0};
    if (ends)
        end_dialogue();
    if (code == 0 || !event)
        return 0;
    // The key form of the library's event: type 1, then state (1: down), code, modifiers, character.
    std::array<std::byte, 12> bytes{std::byte{1}, std::byte{1}};
    std::uint16_t modifiers = 0;
    if (key)
        modifiers = static_cast<std::uint16_t>((key->shift ? 0x1 : 0) | (key->control ? 0x40 : 0) |
                                               (key->alt ? 0x100 : 0));
    const std::uint16_t character = code < 0x80 ? code : std::uint16_t{0};
    std::memcpy(bytes.data() + 2, &code, 2);
    std::memcpy(bytes.data() + 4, &modifiers, 2);
    std::memcpy(bytes.data() + 6, &character, 2);
    std::memcpy(event, bytes.data(), bytes.size());
    return 1;
}

} // namespace overt
