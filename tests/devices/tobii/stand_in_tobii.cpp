// A library that answers as Tobii's libtobii_research.so does, for tests: written from the published
// description of its functions, with trackers in memory whose gaze is known. Variants are compiled with
//   STAND_IN_1         the data of version 1
//   STAND_IN_3         another version
//   STAND_IN_LACKING   without a function that is needed
// Tests steer it through the functions stand_in_….
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#if defined STAND_IN_1
constexpr int major = 1;
#elif defined STAND_IN_3
constexpr int major = 3;
#else
constexpr int major = 2;
#endif

namespace {

using namespace std::chrono_literals;

constexpr std::int64_t device_ahead_us = 7'000'000'000; // of the tracker's clock
constexpr float offered_hz[] = {60.0f, 120.0f, 300.0f, 600.0f, 1200.0f};

std::mutex lock; // of all below
std::map<std::string, double> numbers;
std::map<std::string, std::string> texts;
std::vector<std::string> said;

/// What a test has set, here or for another process in the environment.
double number(const char* name, double otherwise) {
    const std::scoped_lock held(lock);
    const auto found = numbers.find(name);
    if (found != numbers.end())
        return found->second;
    const char* const told = std::getenv((std::string("STAND_IN_TOBII_") + name).c_str());
    return told ? std::atof(told) : otherwise;
}
int status(const char* name) { return static_cast<int>(number(name, 0)); }
void say(const std::string& text) {
    const std::scoped_lock held(lock);
    said.push_back(text);
}
std::int64_t system_us() {
    return std::chrono::duration_cast<std::chrono::microseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

struct Point2 {
    float x, y;
};
struct Point3 {
    float x, y, z;
};
struct Origin {
    Point3 place;
#ifdef STAND_IN_1
    Point3 in_track_box;
#endif
    int validity;
};
struct Eye {
    Point2 on_display;
    Point3 in_space;
    int gaze_validity;
    float pupil;
    int pupil_validity;
    Origin origin;
};
struct Gaze {
    Eye left, right;
    std::int64_t device, system;
};
struct Sync {
    std::int64_t request, device, response;
};
struct Signal {
    std::int64_t device, system;
    std::uint32_t value;
    int change;
};
struct StreamError {
    std::int64_t system;
    int error, source;
    const char* message;
};
struct Notification {
    std::int64_t system;
    int kind;
    char text[512];
};

template <class Data> struct Subscription {
    void (*callback)(Data*, void*) = nullptr;
    void* user = nullptr;
    void tell(Data data) const {
        if (callback)
            callback(&data, user);
    }
};
Subscription<Gaze> gaze;
Subscription<Sync> syncs;
Subscription<Signal> signals;
Subscription<StreamError> errors;
Subscription<Notification> notifications;
std::jthread pump;

Eye eye_at(float x, float y, float pupil, bool valid, float place) {
    Eye eye{};
    eye.on_display = {x, y};
    eye.pupil = pupil;
    eye.origin.place = {place, 2.0f, 600.0f};
    eye.gaze_validity = eye.pupil_validity = eye.origin.validity = valid;
    return eye;
}

void notify(int kind, const char* text) {
    Notification notification{};
    notification.kind = kind;
    std::strncpy(notification.text, text, sizeof notification.text - 1);
    notifications.tell(notification);
}

void run(const std::stop_token& stop) {
    const auto period_us = static_cast<std::int64_t>(1e6 / number("hz", 600));
    const std::int64_t begin = system_us();
    signals.tell({begin + device_ahead_us, begin, 4, 1});
    for (std::int64_t i = 0; !stop.stop_requested(); ++i) {
        const std::int64_t taken = begin + i * period_us;
        std::this_thread::sleep_until(
            std::chrono::steady_clock::time_point(std::chrono::microseconds(taken)));
        if (i == static_cast<std::int64_t>(number("silent_from", 1e9)))
            return;
        if (i == static_cast<std::int64_t>(number("lost_at", 1e9)))
            return notify(0, "");
        if (i == static_cast<std::int64_t>(number("stream_lost_at", 1e9)))
            return errors.tell({taken, 0, 1, "the cable"});
        if (i == static_cast<std::int64_t>(number("fault_at", 1e9)))
            notify(major == 1 ? 9 : 8, "the camera is hot");
        if (i == static_cast<std::int64_t>(number("dropped_at", 1e9)))
            notify(10, "");
        if (i == 5)
            signals.tell({taken + device_ahead_us, taken, 4, 0}); // no other value
        if (i == 6)
            signals.tell({taken + device_ahead_us, taken, 5, 0});
        const auto missing = static_cast<std::int64_t>(number("missing_from", 1e9));
        if (i >= missing && i < missing + static_cast<std::int64_t>(number("missing_count", 3)))
            continue;
        const bool has_left = i % 10 != 9;
        const bool is_back = i == static_cast<std::int64_t>(number("back_at", 1e9)) ||
                             i >= static_cast<std::int64_t>(number("back_from", 1e9));
        const std::int64_t device = taken + device_ahead_us - (is_back ? 1'000'000'000 : 0);
        const int times = i == static_cast<std::int64_t>(number("twice_at", 1e9)) ? 2 : 1;
        for (int told = 0; told < times; ++told)
            gaze.tell({eye_at(0.25f, 0.75f, 3.0f, has_left, -30.0f), eye_at(0.5f, 0.5f, 4.0f, true, 30.0f),
                       device, taken});
    }
}

template <class Data>
int subscribe(Subscription<Data>& to, const char* name, void (*callback)(Data*, void*), void* user) {
    if (const int refused = status((std::string(name) + "_status").c_str()))
        return refused;
    say(std::string("subscribe ") + name);
    to = {callback, user};
    return 0;
}
template <class Data> int unsubscribe(Subscription<Data>& from, const char* name) {
    if (!from.callback)
        return 213;
    say(std::string("unsubscribe ") + name);
    from = {};
    return 0;
}

struct Area {
    Point3 bottom_left, bottom_right;
    float height;
    Point3 top_left, top_right;
    float width;
};
struct Trackers {
    void** trackers;
    std::size_t count;
};
struct Frequencies {
    float* hz;
    std::size_t count;
};
struct CalibrationEye {
    Point2 place;
    int validity;
};
struct CalibrationSample {
    CalibrationEye left, right;
};
struct CalibrationPoint {
    Point2 place;
    CalibrationSample* samples;
    std::size_t count;
};
struct CalibrationResult {
    CalibrationPoint* points;
    std::size_t count;
    int status;
};

int devices[3]; // whose addresses are the trackers
[[maybe_unused]] void* devices_at[3] = {&devices[0], &devices[1], &devices[2]};
int held = 0; // of what a caller has to free
std::vector<Point2> collected;

int text(const char* name, const std::string& otherwise, char** into) {
    const std::scoped_lock locked(lock);
    const auto found = texts.find(name);
    const std::string& value = found == texts.end() ? otherwise : found->second;
    *into = new char[value.size() + 1];
    std::memcpy(*into, value.c_str(), value.size() + 1);
    ++held;
    return 0;
}
std::string number_of(const void* tracker) {
    return std::to_string(static_cast<const int*>(tracker) - devices + 1);
}

} // namespace

#define FUNCTION(type, name) extern "C" __attribute__((visibility("default"))) type name

FUNCTION(void, stand_in_reset)() {
    pump = {};
    const std::scoped_lock locked(lock);
    numbers.clear();
    texts.clear();
    said.clear();
    collected.clear();
    held = 0;
    gaze = {};
    syncs = {};
    signals = {};
    errors = {};
    notifications = {};
}
FUNCTION(void, stand_in_set)(const char* name, double value) {
    const std::scoped_lock locked(lock);
    numbers[name] = value;
}
FUNCTION(void, stand_in_tell)(const char* name, const char* value) {
    const std::scoped_lock locked(lock);
    texts[name] = value;
}
FUNCTION(const char*, stand_in_said)(int index) {
    const std::scoped_lock locked(lock);
    return index < static_cast<int>(said.size()) ? said[static_cast<std::size_t>(index)].c_str() : nullptr;
}
FUNCTION(int, stand_in_held)() { return held; }

FUNCTION(int, tobii_research_get_sdk_version)(int* version) {
    version[0] = major;
    version[1] = 11;
    version[2] = 7;
    version[3] = 0;
    return 0;
}
FUNCTION(int, tobii_research_get_system_time_stamp)(std::int64_t* us) {
    *us = system_us();
    return status("clock_status");
}
#ifndef STAND_IN_LACKING
FUNCTION(int, tobii_research_find_all_eyetrackers)(Trackers** found) {
    if (const int refused = status("find_status"))
        return refused;
    *found = new Trackers{devices_at, static_cast<std::size_t>(number("devices", 1))};
    ++held;
    return 0;
}
#endif
FUNCTION(void, tobii_research_free_eyetrackers)(Trackers* found) {
    --held;
    delete found;
}
FUNCTION(int, tobii_research_get_eyetracker)(const char* address, void** tracker) {
    if (address == std::string("tet-tcp://nothing"))
        return 0; // without a tracker
    if (address != std::string("tet-tcp://10.0.0.7"))
        return 204;
    *tracker = &devices[2];
    return 0;
}
FUNCTION(void, tobii_research_free_string)(char* string) {
    --held;
    delete[] string;
}
FUNCTION(int, tobii_research_get_address)(void* tracker, char** into) {
    return text("address", "tet-tcp://10.0.0." + number_of(tracker), into);
}
FUNCTION(int, tobii_research_get_serial_number)(void* tracker, char** into) {
    return text("serial", "SER" + number_of(tracker), into);
}
FUNCTION(int, tobii_research_get_model)(void*, char** into) { return text("model", "Glass 9000", into); }
FUNCTION(int, tobii_research_get_firmware_version)(void*, char** into) {
    return text("firmware", "2.6", into);
}
FUNCTION(int, tobii_research_get_capabilities)(void*, int* bits) {
    *bits = static_cast<int>(number("capabilities", 0b101011));
    return status("capabilities_status");
}
FUNCTION(int, tobii_research_get_display_area)(void*, Area* area) {
    *area = {};
    area->width = static_cast<float>(number("width_mm", 698.0));
    area->height = static_cast<float>(number("height_mm", 393.0));
    return status("area_status");
}
FUNCTION(int, tobii_research_get_all_gaze_output_frequencies)(void*, Frequencies** offered) {
    const double count = number("frequencies", std::size(offered_hz));
    if (count < 0)
        return 0; // without any
    *offered = new Frequencies{const_cast<float*>(offered_hz), static_cast<std::size_t>(count)};
    ++held;
    return status("frequencies_status");
}
FUNCTION(void, tobii_research_free_gaze_output_frequencies)(Frequencies* offered) {
    --held;
    delete offered;
}
FUNCTION(int, tobii_research_get_gaze_output_frequency)(void*, float* hz) {
    *hz = static_cast<float>(number("hz", 600));
    return status("told_rate_status");
}
FUNCTION(int, tobii_research_set_gaze_output_frequency)(void*, float hz) {
    say("rate " + std::to_string(static_cast<int>(hz)));
    if (const int refused = status("rate_status"))
        return refused;
    const std::scoped_lock locked(lock);
    numbers["hz"] = static_cast<double>(hz);
    return 0;
}

FUNCTION(int, tobii_research_subscribe_to_gaze_data)(void*, void (*callback)(Gaze*, void*), void* user) {
    const int done = subscribe(gaze, "gaze", callback, user);
    if (done == 0)
        pump = std::jthread(run);
    return done;
}
FUNCTION(int, tobii_research_unsubscribe_from_gaze_data)(void*, void (*)(Gaze*, void*)) {
    pump = {};
    return unsubscribe(gaze, "gaze");
}
FUNCTION(int, tobii_research_subscribe_to_time_synchronization_data)
(void*, void (*callback)(Sync*, void*), void* user) {
    const int done = subscribe(syncs, "time", callback, user);
    for (int i = 0; done == 0 && i < static_cast<int>(number("syncs", 2)); ++i) {
        const std::int64_t now = system_us();
        syncs.tell({now - static_cast<std::int64_t>(number("asked_before_us", 300)),
                    now - 200 + device_ahead_us,
                    now - static_cast<std::int64_t>(number("answered_before_us", 0))});
    }
    return done;
}
FUNCTION(int, tobii_research_unsubscribe_from_time_synchronization_data)(void*, void (*)(Sync*, void*)) {
    return unsubscribe(syncs, "time");
}
FUNCTION(int, tobii_research_subscribe_to_external_signal_data)
(void*, void (*callback)(Signal*, void*), void* user) { return subscribe(signals, "port", callback, user); }
FUNCTION(int, tobii_research_unsubscribe_from_external_signal_data)(void*, void (*)(Signal*, void*)) {
    return unsubscribe(signals, "port");
}
FUNCTION(int, tobii_research_subscribe_to_stream_errors)
(void*, void (*callback)(StreamError*, void*), void* user) {
    return subscribe(errors, "errors", callback, user);
}
FUNCTION(int, tobii_research_unsubscribe_from_stream_errors)(void*, void (*)(StreamError*, void*)) {
    return unsubscribe(errors, "errors");
}
FUNCTION(int, tobii_research_subscribe_to_notifications)
(void*, void (*callback)(Notification*, void*), void* user) {
    return subscribe(notifications, "notifications", callback, user);
}
FUNCTION(int, tobii_research_unsubscribe_from_notifications)(void*, void (*)(Notification*, void*)) {
    return unsubscribe(notifications, "notifications");
}

FUNCTION(int, tobii_research_screen_based_calibration_enter_calibration_mode)(void*) {
    say("enter");
    collected.clear();
    return status("enter_status");
}
FUNCTION(int, tobii_research_screen_based_calibration_leave_calibration_mode)(void*) {
    say("leave");
    return 0;
}
FUNCTION(int, tobii_research_screen_based_calibration_collect_data)(void*, float x, float y) {
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(number("collect_ms", 0))));
    const auto place =
        std::to_string(static_cast<int>(x * 1000)) + " " + std::to_string(static_cast<int>(y * 1000));
    say("collect " + place);
    const std::scoped_lock locked(lock);
    const auto refused = texts.find("cannot_measure_once_at");
    if (refused != texts.end() && refused->second == place) {
        texts.erase(refused);
        return 214;
    }
    const auto never = texts.find("cannot_measure_at");
    if (never != texts.end() && never->second == place)
        return 214;
    collected.push_back({x, y});
    return 0;
}
FUNCTION(int, tobii_research_screen_based_calibration_discard_data)(void*, float x, float y) {
    say("discard " + std::to_string(static_cast<int>(x * 1000)) + " " +
        std::to_string(static_cast<int>(y * 1000)));
    return 0;
}
FUNCTION(int, tobii_research_screen_based_calibration_compute_and_apply)(void*, CalibrationResult** result) {
    say("compute");
    if (const int refused = status("compute_status"))
        return refused;
    auto* made = new CalibrationResult{};
    made->status = static_cast<int>(number("calibration", 1));
    made->count = collected.size();
    made->points = new CalibrationPoint[collected.size()];
    for (std::size_t i = 0; i < collected.size(); ++i) {
        const Point2 at = collected[i];
        // Each eye's gaze is off by 0.01 to one side and by 0.01 up and down; a third sample was not used.
        made->points[i] = {
            at,
            new CalibrationSample[3]{{{{at.x - 0.01f, at.y - 0.01f}, 1}, {{at.x + 0.02f, at.y}, 1}},
                                     {{{at.x - 0.01f, at.y + 0.01f}, 1}, {{at.x + 0.02f, at.y}, 1}},
                                     {{{0.0f, 0.0f}, 0}, {{0.0f, 0.0f}, -1}}},
            3};
    }
    ++held;
    *result = made;
    return 0;
}
FUNCTION(void, tobii_research_free_screen_based_calibration_result)(CalibrationResult* result) {
    for (std::size_t i = 0; i < result->count; ++i)
        delete[] result->points[i].samples;
    delete[] result->points;
    delete result;
    --held;
}
