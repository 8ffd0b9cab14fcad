/// The dialogue of an EyeLink's set-up on overt's own screen: what the library asks for through its hooks,
/// done on the set-up screen.
#pragma once

#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "devices/eyelink/eyelink_library.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/setup_screen.h"

namespace overt {

/// What the library knows a key by; 0: it knows none.
std::uint16_t eyelink_key(const SetupKey& key) noexcept;

/// Lends a set-up screen to the library while it lives: one at a time, on the thread that calls the library.
/// What the set-up screen throws never passes through the library: the dialogue is ended and check() throws
/// it again. The hooks stay registered afterwards, since the library also asks for keys at other times, such
/// as while it fetches a file: they then do nothing and give no key.
class EyelinkSetup {
  public:
    /// Without a set-up screen (nullptr) nothing is drawn and no key comes: a check of drift, whose target is
    /// shown already. From `until` on the dialogue is ended from here.
    EyelinkSetup(const EyelinkLibrary& library, SetupScreen* setup_screen, Degrees target, const Clock& clock,
                 SessionTime until);
    ~EyelinkSetup();
    EyelinkSetup(const EyelinkSetup&) = delete;
    EyelinkSetup& operator=(const EyelinkSetup&) = delete;

    /// Throws what the set-up screen threw, or DeviceError if the connection was lost.
    void check() const;

    /// It was ended because the time was over.
    bool is_out_of_time() const noexcept { return is_out_of_time_; }

    // What the hooks do; 0 is done, as the library has it.
    std::int16_t set_up() noexcept;
    std::int16_t clear() noexcept;
    std::int16_t draw_target(double x_px, double y_px) noexcept;
    std::int16_t beep(int which) noexcept;
    std::int16_t image_title(std::string title) noexcept;
    std::int16_t image_palette(std::span<const std::uint8_t> red, std::span<const std::uint8_t> green,
                               std::span<const std::uint8_t> blue) noexcept;
    std::int16_t image_line(int width, int line, int lines, const std::uint8_t* indices) noexcept;
    std::int16_t image(int width, int height, const std::uint8_t* rgba) noexcept;
    std::int16_t alert(std::string text) noexcept;
    /// Fills in a key event of 12 bytes and gives 1, or 0 if there is no key.
    std::int16_t input_key(void* event) noexcept;

  private:
    template <class Work> std::int16_t guarded(const Work& work) noexcept;
    void end_dialogue() noexcept;

    const EyelinkLibrary* library_;
    SetupScreen* setup_screen_;
    Degrees target_;
    const Clock* clock_;
    SessionTime until_;
    bool is_out_of_time_ = false, is_connection_lost_ = false;
    std::exception_ptr thrown_;
    CameraImage camera_;
    std::vector<std::byte> palette_; ///< four bytes a colour
};

} // namespace overt
