/// The EyeLink's own library, which SR Research gives to owners of a tracker: loaded when a session asks for
/// it, never part of overt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "devices/link/shared_library.h"

namespace overt {

/// What the library calls for the 17 things that a calibration needs of the screen, in its order (first
/// form).
struct EyelinkHooks {
    std::int16_t (*set_up)();
    void (*leave)();
    void (*recording_broken_off)();
    std::int16_t (*set_up_image)(std::int16_t width, std::int16_t height);
    void (*image_title)(std::int16_t threshold, char* name);
    void (*image_line)(std::int16_t width, std::int16_t line, std::int16_t lines, std::uint8_t* indices);
    void (*image_palette)(std::int16_t colours, std::uint8_t* red, std::uint8_t* green, std::uint8_t* blue);
    void (*leave_image)();
    void (*clear)();
    void (*erase_target)();
    void (*draw_target)(std::int16_t x, std::int16_t y);
    void (*target_beep)();
    void (*calibration_beep)(std::int16_t error);
    void (*drift_beep)(std::int16_t error);
    void (*drift_target_beep)();
    std::int16_t (*input_key)(void* event);
    void (*alert)(const char* text);
};
static_assert(sizeof(EyelinkHooks) == 17 * sizeof(void*));

/// The second form: each is given `user`, and 0 means done.
struct EyelinkHooks2 {
    std::int32_t major, minor;
    void* user;
    std::int16_t (*set_up)(void* user);
    std::int16_t (*leave)(void* user);
    std::int16_t (*set_up_image)(void* user, std::int16_t width, std::int16_t height);
    std::int16_t (*image_title)(void* user, char* title);
    std::int16_t (*image)(void* user, std::int16_t width, std::int16_t height, std::uint8_t* rgba);
    std::int16_t (*leave_image)(void* user);
    std::int16_t (*clear)(void* user);
    std::int16_t (*erase_target)(void* user);
    std::int16_t (*draw_target)(void* user, float x, float y);
    std::int16_t (*beep)(void* user, std::int32_t which);
    std::int16_t (*input_key)(void* user, void* event);
    std::int16_t (*alert)(void* user, const char* text);
    std::int32_t reserved[4];
};
static_assert(sizeof(EyelinkHooks2) == 128 && offsetof(EyelinkHooks2, user) == 8);

/// Functions of the library by the names it gives them. Those marked optional are absent in older libraries,
/// and then null. The library is not safe to call from two threads at once.
struct EyelinkFunctions {
    using i16 = std::int16_t;
    using u32 = std::uint32_t;
    i16 (*set_eyelink_address)(char* address) = nullptr;
    i16 (*open_eyelink_connection)(i16 mode) = nullptr;
    void (*close_eyelink_connection)() = nullptr;
    i16 (*eyelink_is_connected)() = nullptr;
    i16 (*eyelink_get_tracker_version)(char* text) = nullptr;
    i16 (*eyecmd_printf)(const char* format, ...) = nullptr;
    i16 (*eyemsg_printf)(const char* format, ...) = nullptr;
    i16 (*eyelink_read_request)(char* variable) = nullptr;
    i16 (*eyelink_read_reply)(char* text) = nullptr;
    i16 (*eyelink_last_message)(char* text) = nullptr;
    i16 (*open_data_file)(char* name) = nullptr;
    i16 (*close_data_file)() = nullptr;
    void (*set_offline_mode)() = nullptr;
    i16 (*do_tracker_setup)() = nullptr;
    i16 (*do_drift_correct)(i16 x, i16 y, i16 draw, i16 allow_setup) = nullptr;
    void (*exit_calibration)() = nullptr;
    i16 (*eyelink_cal_result)() = nullptr;
    i16 (*eyelink_cal_message)(char* text) = nullptr;
    i16 (*start_recording)(i16 file_samples, i16 file_events, i16 link_samples, i16 link_events) = nullptr;
    i16 (*check_recording)() = nullptr;
    void (*stop_recording)() = nullptr;
    i16 (*check_record_exit)() = nullptr;
    i16 (*eyelink_wait_for_block_start)(u32 ms, i16 samples, i16 events) = nullptr;
    i16 (*eyelink_eye_available)() = nullptr;
    i16 (*eyelink_get_next_data)(void* item) = nullptr;
    i16 (*eyelink_get_float_data)(void* item) = nullptr;
    i16 (*eyelink_reset_data)(i16 clear) = nullptr;
    u32 (*eyelink_request_time)() = nullptr;
    u32 (*eyelink_read_time)() = nullptr;
    void (*setup_graphic_hook_functions)(EyelinkHooks* hooks) = nullptr;
    std::int32_t (*receive_data_file)(char* source, char* destination, i16 is_folder) = nullptr;

    // Optional.
    // NOLINTNEXTLINE(readability-identifier-naming): the maker's name
    i16 (*setup_graphic_hook_functions_V2)(EyelinkHooks2* hooks) = nullptr;
    std::int32_t (*receive_data_file_feedback)(char* source, char* destination, i16 is_folder,
                                               void (*progress)(unsigned size, unsigned received)) = nullptr;
    double (*eyelink_tracker_double_usec)() = nullptr;
    i16 (*eyelink_mode_data)(i16* rate, i16* mode, i16* file_filter, i16* link_filter) = nullptr;
};

/// The library, loaded.
class EyelinkLibrary {
  public:
    /// From `path`; if that is empty, from the environment variable OVERT_EYELINK_LIBRARY; else by the name
    /// libeyelink_core.so from where the system looks for libraries. Throws DeviceError saying what the
    /// system said or which functions the library lacks, and where it is to be had.
    explicit EyelinkLibrary(const std::string& path = {});

    const EyelinkFunctions& operator*() const noexcept { return functions_; }
    const EyelinkFunctions* operator->() const noexcept { return &functions_; }

    /// What it was loaded from.
    const std::string& path() const noexcept { return library_.file(); }

  private:
    SharedLibrary library_;
    EyelinkFunctions functions_;
};

} // namespace overt
