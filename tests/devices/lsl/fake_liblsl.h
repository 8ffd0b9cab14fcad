/// A stand-in for liblsl: the functions of its C interface that the program calls, over streams that a test
/// makes up. Built as a library of its own and loaded as the real one is.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace overt::test {

/// An element of XML.
struct FakeXml {
    std::string name, text;
    std::list<FakeXml> children;
    FakeXml* parent = nullptr;

    FakeXml& add(const std::string& child, const std::string& content = {}) {
        children.push_back({child, content, {}, this});
        return children.back();
    }
};

/// No two streams have the same.
inline std::string next_uid() {
    static std::atomic<int> streams{0};
    return "uid of stream " + std::to_string(++streams);
}

struct FakeStream {
    std::string name, type, source, host = "tracker-pc", uid = next_uid();
    int channels = 0, format = 2;
    double rate_hz = 0.0;
    FakeXml desc{"desc", {}, {}, nullptr};

    // Of one that is received.
    std::atomic<bool> is_lost{false}, answers{true};
    std::atomic<int> open_error{0}, correction_error{0};
    int unheard = 0; ///< so many searches do not find it, as if their packets were lost
    bool is_open = false;
    double correction_s = 0.0, uncertainty_s = 0.0002; ///< of its clock to this machine's
    struct Sample {
        double time_s;
        std::vector<double> values;
    };
    std::deque<Sample> waiting;

    // Of one that is sent.
    struct Pushed {
        double time_s;
        std::string text;
        std::vector<double> values;
    };
    std::vector<Pushed> pushed;

    void add_channel(const std::string& label, const std::string& eye, const std::string& measured,
                     const std::string& unit, const std::string& coordinate_system = "screen") {
        if (desc.children.empty())
            desc.add("channels");
        FakeXml& channel = desc.children.front().add("channel");
        channel.add("label", label);
        channel.add("eye", eye);
        channel.add("type", measured);
        channel.add("unit", unit);
        channel.add("coordinate_system", coordinate_system);
        ++channels;
    }
};

/// All under the lock.
struct FakeLsl {
    std::mutex mutex;
    std::condition_variable fed;
    std::list<std::shared_ptr<FakeStream>> network; ///< what can be found
    std::list<std::shared_ptr<FakeStream>> sent;    ///< outlets, also those that are gone
    int inlets = 0, outlets = 0, infos = 0;         ///< that are not destroyed
    std::vector<std::string> asked;                 ///< what was called with which numbers and texts
    std::string refused;                            ///< what gives nothing: "inlet", "info", "outlet", "push"

    void feed(FakeStream& stream, double time_s, std::vector<double> values) {
        const std::scoped_lock lock(mutex);
        if (stream.is_open)
            stream.waiting.push_back({time_s, std::move(values)});
        fed.notify_all();
    }
};

} // namespace overt::test

extern "C" overt::test::FakeLsl* fake_lsl();
extern "C" double lsl_local_clock();
