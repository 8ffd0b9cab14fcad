#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/devices/display_box/box_bench.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// All that can be said to a box, as one text.
std::string whole_conversation(const std::function<std::size_t()>& piece) {
    Bench bench;
    bench.box.model.video = ramp;
    bench.box.model.before_reply = "$touch;9.125000;0100;0200;1;\r";
    bench.box.far.piece = piece;
    // Reading in small pieces takes time, which must not show: the stream ends before the questions go on.
    std::string said;
    auto display = bench.open();
    said += display.identity().product + display.identity().serial_number + display.identity().firmware_date;
    said += fmt::format(" {}", display.video_rate_hz());
    for (const RgbBytes& bytes : display.read_video_line(3, 300))
        said += fmt::format(" {},{},{}", bytes[0], bytes[1], bytes[2]);
    said += fmt::format(" {}", display.set_mode(BoxMode::mono_plus_plus).rate_hz);
    LineSplitter splitter(longest_bits_line);
    std::string stream;
    for (const double time_s : {1.5, 1.6, 1.7})
        stream += bench.box.model.status_line(time_s) + "\n";
    for (std::size_t at = 0; at < stream.size();) {
        const std::size_t length = piece ? std::max<std::size_t>(1, piece()) : stream.size();
        splitter.feed(std::string_view(stream).substr(at, length), [&said](std::string_view line) {
            const auto sample = parse_status_line(line);
            said += sample ? fmt::format(" {}@{}", sample->number, to_seconds(sample->at)) : " no sample";
        });
        at += length;
    }
    return said;
}

} // namespace

TEST_CASE("however what the box says is split on its way, the same is understood", "[unit]") {
    const std::string whole = whole_conversation({});
    CHECK_THAT(whole, Contains("Display++DPP-0042Mar 14 2018 120") && Contains(" 3@1.7"));
    CHECK(whole_conversation([] { return std::size_t{1}; }) == whole);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        RandomStream random(seed, "split test");
        const auto piece = [&random] {
            return static_cast<std::size_t>(std::ceil(random.exponential(1.0) * 20.0));
        };
        CHECK(whole_conversation(piece) == whole);
    }
}

TEST_CASE("no damage to what the box says makes the program hang or fall", "[unit]") {
    int answered = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        RandomStream random(seed, "damage test");
        const auto below = [&random](std::size_t n) {
            return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(n)), n - 1);
        };
        Bench bench;
        bench.box.model.video = ramp;
        const double chance = random.uniform();
        bench.box.mutate = [&](std::string text) {
            while (!text.empty() && random.uniform() < chance * 0.6) {
                const std::size_t at = below(text.size());
                switch (below(6)) {
                case 0:
                    text[at] = static_cast<char>(below(256));
                    break;
                case 1:
                    text.erase(at, 1 + below(20));
                    break;
                case 2:
                    text.insert(at, text.substr(below(text.size()), 1 + below(60)));
                    break;
                case 3:
                    text.insert(at, std::string(1 + below(5), ";\r\n#$9-.e\0"[below(10)]));
                    break;
                case 4:
                    text.resize(at);
                    break;
                default:
                    text += text;
                    text.resize(std::min<std::size_t>(text.size(), 100000));
                }
            }
            return text;
        };
        const SessionTime begun = bench.clock.now();
        try {
            auto display = bench.open();
            const double rate_hz = display.video_rate_hz();
            CHECK((rate_hz >= 0.0 && rate_hz < 1000.0));
            const std::size_t pixels = display.read_video_line(1, 8).size();
            CHECK(pixels == 8);
            display.read_clocks();
            display.set_mode(BoxMode::mono_plus_plus);
            ++answered;
        } catch (const DeviceError&) {
            ++refused;
        }
        // The longest way: each question at its limit, the change of mode, and the way back in the
        // destructor.
        CHECK(to_seconds(bench.clock.now() - begun) < 40.0);
    }
    CHECK(answered > 100);
    CHECK(refused > 100);
}
