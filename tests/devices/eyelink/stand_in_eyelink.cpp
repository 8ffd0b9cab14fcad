// A library that answers as the vendor's libeyelink_core.so does, for tests: written from the published
// description of its functions, with a tracker in memory whose gaze is known. Variants are compiled with
//   STAND_IN_OLD       without the functions that came later
//   STAND_IN_LACKING   without two functions that are needed
// Tests steer it through the functions stand_in_…, or, where it is loaded by the program, by the environment:
// STAND_IN_EYELINK_rate=500.
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

using i16 = std::int16_t;
using Clock = std::chrono::steady_clock;
constexpr i16 no_reply = 1000;
constexpr double host_ahead_us = 5'000'000'000.0; // of the host's clock

std::map<std::string, double> numbers; // what tests have set
std::map<std::string, std::string> texts;
std::map<std::string, std::string> variables; // of the host, as commands set them
std::vector<std::string> said;                // commands, messages, keys and calls, in their order
int link = 0;
bool recording = false, has_left_dialogue = false;
double begun_us = 0.0;
std::int64_t given = 0; // samples of this recording
unsigned char item[128];
i16 item_bytes = 0;
int times_asked = 0, times_offline = 0;
void (*last_progress)(unsigned, unsigned) = nullptr;

double number(const char* name, double otherwise) {
    const auto found = numbers.find(name);
    if (found != numbers.end())
        return found->second;
    const char* const told = std::getenv((std::string("STAND_IN_EYELINK_") + name).c_str());
    return told ? std::atof(told) : otherwise;
}
/// What is called besides commands and messages, where a test wants to know all.
void trace(const std::string& what) {
    if (number("trace", 0) != 0)
        said.push_back(what);
}
/// As the host was told, unless somebody has set another rate there.
double sample_rate_hz() {
    const auto told = variables.find("sample_rate");
    return number("rate", told == variables.end() ? 1000.0 : std::atof(told->second.c_str()));
}
double local_us() {
    return std::chrono::duration<double, std::micro>(Clock::now().time_since_epoch()).count();
}
double host_us() { return std::fmod(local_us(), 1e12) + host_ahead_us; }

/// As a library does that reads where nothing is; a sanitizer would stop it before it crashes.
[[gnu::no_sanitize("undefined")]] void crash_if_told(const char* when) {
    if (number(when, 0) == 0)
        return;
    volatile int* const nowhere = nullptr;
    *nowhere = 1;
}

template <class T> void put(int offset, T value) { std::memcpy(item + offset, &value, sizeof value); }

void make_sample(std::int64_t half_ms, std::int64_t index) {
    std::memset(item, 0, sizeof item);
    const bool left = number("eyes", 1) != 1, right = number("eyes", 1) != 0;
    put<std::uint32_t>(0, static_cast<std::uint32_t>(half_ms / 2));
    put<i16>(4, 200);
    put<std::uint16_t>(6, static_cast<std::uint16_t>((left ? 0x8000 : 0) | (right ? 0x4000 : 0) | 0x2000 |
                                                     0x0400 | 0x0100 | (half_ms % 2 ? 0x0002 : 0)));
    for (int eye = 0; eye < 2; ++eye) {
        const bool measured = (eye == 0 ? left : right) && index % 500 != 499; // a lost pupil now and then
        put<float>(40 + 4 * eye, measured ? 900.0f + static_cast<float>(eye) : -32768.0f);
        put<float>(48 + 4 * eye, measured ? static_cast<float>(index) : -32768.0f);
        put<float>(56 + 4 * eye, measured ? 540.0f + static_cast<float>(eye) : -32768.0f);
    }
    item_bytes = 96;
}

} // namespace

struct Hooks {
    i16 (*set_up)();
    void (*leave)();
    void (*hide)();
    i16 (*set_up_image)(i16, i16);
    void (*title)(i16, char*);
    void (*line)(i16, i16, i16, unsigned char*);
    void (*palette)(i16, unsigned char*, unsigned char*, unsigned char*);
    void (*leave_image)();
    void (*clear)();
    void (*erase)();
    void (*target)(i16, i16);
    void (*target_beep)();
    void (*done_beep)(i16);
    void (*drift_beep)(i16);
    void (*drift_target_beep)();
    i16 (*key)(void*);
    void (*alert)(const char*);
};
struct Hooks2 {
    int major, minor;
    void* user;
    i16 (*set_up)(void*);
    i16 (*leave)(void*);
    i16 (*set_up_image)(void*, i16, i16);
    i16 (*title)(void*, char*);
    i16 (*image)(void*, i16, i16, unsigned char*);
    i16 (*leave_image)(void*);
    i16 (*clear)(void*);
    i16 (*erase)(void*);
    i16 (*target)(void*, float, float);
    i16 (*beep)(void*, int);
    i16 (*key)(void*, void*);
    i16 (*alert)(void*, const char*);
    int reserved[4];
};

namespace {

Hooks hooks{};
Hooks2 hooks2{};
bool uses_hooks2 = false;

// Both forms of hooks, as one.
void show_target(float x, float y) {
    if (uses_hooks2) {
        hooks2.clear(hooks2.user);
        hooks2.target(hooks2.user, x, y);
        hooks2.beep(hooks2.user, 1);
    } else {
        hooks.clear();
        hooks.target(static_cast<i16>(x), static_cast<i16>(y));
        hooks.target_beep();
    }
}

void show_camera() {
    constexpr int width = 32, height = 24;
    if (uses_hooks2) {
        std::vector<unsigned char> rgba(4 * width * height);
        for (int i = 0; i < width * height; ++i) {
            rgba[static_cast<std::size_t>(4 * i)] = static_cast<unsigned char>(i % width);
            rgba[static_cast<std::size_t>(4 * i + 1)] = static_cast<unsigned char>(i / width);
        }
        char title[] = "Left, threshold 80";
        hooks2.set_up_image(hooks2.user, width, height);
        hooks2.title(hooks2.user, title);
        hooks2.image(hooks2.user, width, height, rgba.data());
        hooks2.leave_image(hooks2.user);
        return;
    }
    unsigned char red[64], green[64], blue[64];
    for (int i = 0; i < 64; ++i)
        red[i] = static_cast<unsigned char>(i), green[i] = static_cast<unsigned char>(2 * i), blue[i] = 7;
    char title[] = "Left";
    hooks.set_up_image(width, height);
    hooks.title(80, title);
    hooks.palette(64, red, green, blue);
    for (int y = 1; y <= height; ++y) {
        unsigned char indices[width];
        for (int x = 0; x < width; ++x)
            indices[x] = static_cast<unsigned char>(x);
        hooks.line(width, static_cast<i16>(y), height, indices);
    }
    hooks.leave_image();
}

// The code of the next key, 0 if there is none.
int next_key() {
    unsigned char event[12] = {};
    if (!(uses_hooks2 ? hooks2.key(hooks2.user, event) : hooks.key ? hooks.key(event) : 0))
        return 0;
    std::uint16_t code = 0, modifiers = 0;
    std::memcpy(&code, event + 2, 2);
    std::memcpy(&modifiers, event + 4, 2);
    said.push_back("key " + std::to_string(code) + " type " + std::to_string(event[0]) + " state " +
                   std::to_string(event[1]) + " with " + std::to_string(modifiers));
    return code;
}

void say(const char* what, const char* format, va_list values) {
    char text[1024];
    // This file is compiled several times, and clang-tidy 14 knows va_start only the first time in a run.
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): the callers have started it
    std::vsnprintf(text, sizeof text, format, values);
    said.push_back(std::string(what) + text);
}

// The vendor's functions are given no size: whoever calls them has room for their longest text.
void write_to(char* caller, const std::string& text) { std::memcpy(caller, text.c_str(), text.size() + 1); }

} // namespace

extern "C" {
void stand_in_reset() {
    numbers.clear();
    texts.clear();
    variables.clear();
    said.clear();
    link = 0;
    recording = false;
    times_offline = 0;
    hooks = {};
    hooks2 = {};
    uses_hooks2 = false;
}
void stand_in_set(const char* name, double value) { numbers[name] = value; }
void stand_in_tell(const char* name, const char* text) { texts[name] = text; }
const char* stand_in_said(int index) {
    return index < static_cast<int>(said.size()) ? said[static_cast<std::size_t>(index)].c_str() : nullptr;
}

i16 set_eyelink_address(char* address) {
    said.push_back(std::string("address ") + address);
    return std::strchr(address, '.') ? i16{0} : i16{-1};
}
i16 open_eyelink_connection(i16 mode) {
    trace("connect " + std::to_string(mode));
    const auto result = static_cast<i16>(number("connection", 0));
    link = result != 0 ? 0 : mode == 1 ? -1 : 1;
    return result;
}
void close_eyelink_connection() {
    said.emplace_back("closed");
    crash_if_told("crashes_closing");
    link = 0;
}
i16 eyelink_is_connected() { return static_cast<i16>(number("broken", 0) != 0 ? 0 : link); }
i16 eyelink_get_tracker_version(char* text) {
    write_to(text, "EYELINK CL 5.12");
    return static_cast<i16>(number("version", 3));
}
i16 eyecmd_printf(const char* format, ...) {
    va_list values;
    va_start(values, format);
    say("command ", format, values);
    va_end(values);
    // As a host does: what it does not have it takes without a word, what it has it keeps.
    const std::string command = said.back().substr(std::strlen("command "));
    if (const std::size_t equals = command.find(" = "); equals != std::string::npos)
        variables[command.substr(0, equals)] = command.substr(equals + 3);
    const auto refused = texts.find("refused");
    return refused != texts.end() && said.back().find(refused->second) != std::string::npos ? i16{-3}
                                                                                            : i16{0};
}
i16 eyemsg_printf(const char* format, ...) {
    va_list values;
    va_start(values, format);
    say("message ", format, values);
    va_end(values);
    return 0;
}
i16 eyelink_read_request(char* variable) {
    trace(std::string("read ") + variable);
    if (number("unreadable", 0) != 0)
        return -1;
    texts["asked"] = variable;
    times_asked = 0;
    return 0;
}
i16 eyelink_read_reply(char* text) {
    const std::string& asked = texts["asked"];
    const auto found = texts.find(asked), kept = variables.find(asked);
    if ((found == texts.end() && kept == variables.end()) || ++times_asked < 3)
        return no_reply;
    write_to(text, found == texts.end() ? kept->second : found->second);
    return 0;
}
i16 eyelink_last_message(char* text) {
    const auto told = texts.find("last_message");
    write_to(text, told == texts.end() ? "VALUE OUT OF RANGE" : told->second);
    return static_cast<i16>(std::strlen(text));
}
i16 open_data_file(char* name) {
    said.push_back(std::string("file ") + name);
    return static_cast<i16>(number("open_file", 0));
}
i16 close_data_file() {
    said.emplace_back("file closed");
    return 0;
}
void set_offline_mode() {
    trace("offline");
    recording = false;
    ++times_offline;
}
int stand_in_offline() { return times_offline; }
// Calls each hook that it was given, as a library does at one time or another. Gives the sum of their
// results.
int stand_in_hooks() {
    unsigned char colours[2] = {10, 20}, indices[1] = {1}, rgba[4] = {1, 2, 3, 4}, event[16] = {};
    char title[] = "Left";
    if (!uses_hooks2) {
        int sum = hooks.set_up() + hooks.set_up_image(1, 1);
        hooks.palette(2, colours, colours, colours);
        hooks.palette(0, colours, colours, colours);
        hooks.palette(2, colours, colours, colours);
        for (const i16 threshold : {i16{-1}, i16{0}, i16{80}}) {
            hooks.title(threshold, title);
            hooks.line(1, 1, 1, indices);
        }
        hooks.palette(-1, colours, colours, colours);
        hooks.line(1, 1, 1, indices);
        hooks.leave_image();
        hooks.clear();
        hooks.erase();
        hooks.target(3, 4);
        hooks.target_beep();
        hooks.done_beep(0);
        hooks.done_beep(1);
        hooks.drift_beep(0);
        hooks.drift_beep(1);
        hooks.drift_target_beep();
        hooks.alert("alert");
        hooks.alert(nullptr);
        sum += hooks.key(event);
        hooks.hide();
        hooks.leave();
        return sum;
    }
    void* const user = hooks2.user;
    int sum = hooks2.set_up(user) + hooks2.set_up_image(user, 1, 1) + hooks2.title(user, title) +
              hooks2.image(user, 1, 1, rgba) + hooks2.leave_image(user) + hooks2.clear(user) +
              hooks2.erase(user) + hooks2.target(user, 3.0f, 4.5f);
    for (int which = -2; which <= 3; ++which)
        sum += hooks2.beep(user, which);
    return sum + hooks2.alert(user, "alert") + hooks2.alert(user, nullptr) + hooks2.key(user, event) +
           hooks2.leave(user);
}
// Tells of a transfer that is over once more.
int stand_in_progress() {
    last_progress(9, 3);
    return 0;
}
i16 do_tracker_setup() {
    trace("set up");
    has_left_dialogue = false;
    if (uses_hooks2)
        hooks2.set_up(hooks2.user);
    else
        hooks.set_up();
    numbers["calibrated"] = no_reply;
    if (number("operated", 0) != 0) { // somebody sits at the host
        show_target(960, 540);
        numbers["calibrated"] = 0;
        has_left_dialogue = true;
    }
    for (int i = 0; i < 100'000 && !has_left_dialogue; ++i) {
        const int key = next_key();
        if (key == 0x1B || key == 0x7FFF)
            break;
        if (key == 0x0D)
            show_camera();
        if (key == 'a') {
            if (uses_hooks2)
                hooks2.alert(hooks2.user, "no pupil in 50%s");
            else
                hooks.alert("no pupil in 50%s");
        }
        if (key == 'c') {
            show_target(960, 540);
            show_target(100, 50.5f);
            if (uses_hooks2)
                hooks2.beep(hooks2.user, 0);
            else
                hooks.done_beep(0);
            numbers["calibrated"] = number("calibration", 0);
        }
    }
    if (uses_hooks2)
        hooks2.leave(hooks2.user);
    else
        hooks.leave();
    return 0;
}
i16 do_drift_correct(i16 x, i16 y, i16 draw, i16 allow_setup) {
    has_left_dialogue = false;
    said.push_back("drift " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(draw) + " " +
                   std::to_string(allow_setup));
    const auto escaped = [&] {
        if (allow_setup)
            do_tracker_setup(); // until a key leaves it
        return i16{27};
    };
    if (number("drift", 0) == 27)
        return escaped();
    for (int i = 0; number("drift_waits", 0) != 0 && !has_left_dialogue; ++i)
        if (next_key() == 0x1B)
            return escaped();
    return static_cast<i16>(number("drift", 0));
}
void exit_calibration() {
    trace("exit calibration");
    has_left_dialogue = true;
}
i16 eyelink_cal_result() { return static_cast<i16>(number("calibrated", no_reply)); }
i16 eyelink_cal_message(char* text) {
    write_to(text, texts["calibration"]);
    return static_cast<i16>(std::strlen(text));
}
#ifndef STAND_IN_LACKING
i16 start_recording(i16 file_samples, i16 file_events, i16 link_samples, i16 link_events) {
    said.push_back("start " + std::to_string(file_samples) + std::to_string(file_events) +
                   std::to_string(link_samples) + std::to_string(link_events));
    const auto result = static_cast<i16>(number("start", 0));
    recording = result == 0;
    begun_us = host_us();
    given = 0;
    return result;
}
i16 check_recording() {
    if (number("host", 0) != 0)
        return static_cast<i16>(number("host", 0));
    return recording ? i16{0} : i16{-1};
}
#endif
void stop_recording() {
    said.emplace_back("stop");
    recording = false;
}
i16 check_record_exit() { return static_cast<i16>(number("exit", 0)); }
i16 eyelink_wait_for_block_start(std::uint32_t ms, i16 samples, i16 events) {
    trace("wait " + std::to_string(ms) + " " + std::to_string(samples) + " " + std::to_string(events));
    return static_cast<i16>(number("block", 1));
}
i16 eyelink_eye_available() { return recording ? static_cast<i16>(number("eyes", 1)) : i16{-1}; }
i16 eyelink_get_next_data(void*) {
    if (!recording || number("stalled", 0) != 0)
        return 0;
    const double rate = sample_rate_hz();
    const auto due = static_cast<std::int64_t>((host_us() - begun_us) * 1e-6 * rate);
    if (given >= due)
        return 0;
    if (given == static_cast<std::int64_t>(number("overflow_at", -1))) {
        given += static_cast<std::int64_t>(number("overflow_samples", 0)); // the queue has thrown them away
        numbers.erase("overflow_at");
        return 0x3F;
    }
    const auto half_ms =
        static_cast<std::int64_t>(begun_us / 500.0) + given * static_cast<std::int64_t>(2000.0 / rate);
    make_sample(half_ms, given++);
    if (given > 300)
        crash_if_told("crashes_recording");
    return 200;
}
i16 eyelink_get_float_data(void* into) {
    std::memcpy(into, item, static_cast<std::size_t>(item_bytes));
    return 200;
}
i16 eyelink_reset_data(i16 clears) {
    trace("reset " + std::to_string(clears));
    return 0;
}
std::uint32_t eyelink_request_time() {
    times_asked = 0;
    return 0;
}
std::uint32_t eyelink_read_time() {
    if (number("mute", 0) != 0 || ++times_asked < 3)
        return 0;
    return static_cast<std::uint32_t>(host_us() / 1000.0);
}
void setup_graphic_hook_functions(Hooks* given_hooks) {
    hooks = *given_hooks;
    uses_hooks2 = false;
}
static std::int32_t receive(char* source, char* destination, void (*progress)(unsigned, unsigned)) {
    said.push_back(std::string("fetch ") + source);
    last_progress = progress;
    const auto size = static_cast<unsigned>(number("file_bytes", 100'000));
    const auto result = static_cast<std::int32_t>(number("transfer", size));
    std::FILE* file = std::fopen(destination, "wb");
    if (!file)
        return -111;
    const unsigned sent = result < 0 ? size / 2 : static_cast<unsigned>(number("sent_bytes", size));
    for (unsigned i = 0; i < sent; ++i) {
        std::fputc(static_cast<int>(i % 251), file);
        if (i % 10'000 == 9'999) {
            crash_if_told("crashes_in_transfer");
            // The library looks whether an operator breaks the transfer off, by whatever hooks it has.
            if (hooks.key || hooks2.key)
                next_key();
            if (progress)
                progress(size, i + 1);
        }
    }
    std::fclose(file);
    return result;
}
std::int32_t receive_data_file(char* source, char* destination, i16) {
    return receive(source, destination, nullptr);
}
#ifndef STAND_IN_OLD
std::int32_t receive_data_file_feedback(char* source, char* destination, i16,
                                        void (*progress)(unsigned, unsigned)) {
    return receive(source, destination, progress);
}
// NOLINTNEXTLINE(readability-identifier-naming): the vendor's name, by which the function is looked up
i16 setup_graphic_hook_functions_V2(Hooks2* given_hooks) {
    if (given_hooks->major != 1 || given_hooks->minor != 0 || number("refuses_second_form", 0) != 0)
        return -1;
    hooks2 = *given_hooks;
    uses_hooks2 = true;
    return 0;
}
double eyelink_tracker_double_usec() { return number("microseconds", host_us()); }
i16 eyelink_mode_data(i16* rate, i16* mode, i16* file_filter, i16* link_filter) {
    *rate = static_cast<i16>(sample_rate_hz());
    *mode = *file_filter = *link_filter = 1;
    return 0;
}
#endif
}
