#include "devices/buttons/xid_box.h"

#include "devices/buttons/xid_trigger.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/link/in_memory_line.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

std::string packet(char first, std::initializer_list<int> bytes) {
    std::string text(1, first);
    for (const int byte : bytes)
        text += static_cast<char>(byte);
    return text;
}

std::string little(std::uint32_t ms) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text += static_cast<char>(ms >> (8 * i) & 0xFF);
    return text;
}

/// An RB box in memory: its commands arrive byte by byte.
struct XidModel {
    VirtualClock clock{SessionTime(20s)};
    FarEnd far{clock};
    SessionTime zero;
    int baud = 19200, opened = 0;
    std::string mode = "_xid0", product = "2", model = "3", firmware = "2", heard;

    XidModel() {
        far.port = "/dev/ttyUSB0";
        far.answer = [this](std::string_view bytes) -> std::string {
            if (opened != baud)
                return "";
            heard += bytes;
            const auto is = [&](std::string_view command) { return heard.ends_with(command); };
            if (is("_c1"))
                return mode;
            if (is("c10"))
                mode = "_xid0";
            if (is("_d2"))
                return product;
            if (is("_d3"))
                return model;
            if (is("_d4"))
                return firmware;
            if (is("_e5"))
                return firmware == "1" ? "" : "_e5" + little(ms(clock.now()));
            if (is("e5"))
                zero = clock.now();
            return "";
        };
    }
    std::uint32_t ms(SessionTime at) const { return static_cast<std::uint32_t>((at - zero) / 1ms); }
    void press(SessionTime at, int key, bool down) {
        far.send(at + 2ms, packet('k', {key << 5 | (down ? 0x10 : 0)}) + little(ms(at)));
    }
    XidLine::Opener opener() {
        return [this](const std::string&, int at_baud) {
            opened = at_baud;
            return std::make_unique<InMemoryLine>(far);
        };
    }
    XidBox box() { return {far.port, opener(), clock}; }
};

} // namespace

TEST_CASE("XID packets are found in any pieces and behind noise", "[unit]") {
    const std::string noise = std::string("x\xFFk\x0C", 4);
    const std::string stream = noise + packet('k', {0x70, 0xD2, 0x04, 0, 0}) +
                               packet('k', {0x01, 1, 0, 0, 0x80}) + packet('o', {2, 5, '1', 9, 8, 7, 6, 0});
    for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
        XidParser parser;
        std::vector<XidKey> keys;
        for (std::size_t at = 0; at < stream.size(); at += piece) {
            parser.feed(std::span(stream).subspan(at, std::min(piece, stream.size() - at)));
            while (const auto key = parser.next())
                keys.push_back(*key);
        }
        REQUIRE(keys.size() == 3);
        CHECK(keys[0].key == 3);
        CHECK(keys[0].is_down);
        CHECK(keys[0].ms == 1234);
        CHECK(keys[1].key == 8); // written as 0
        CHECK(keys[1].port == 1);
        CHECK_FALSE(keys[1].is_down);
        CHECK(keys[1].ms == 0x80000001u);
        CHECK(keys[2].port == 2);
        CHECK(keys[2].key == 5);
        CHECK(keys[2].ms == 0x06070809u);
    }
    XidParser full;
    CHECK(full.feed(std::string(300, 'k')) == 256);
    while (full.next()) {
    }
    CHECK(full.feed(std::string(10, 'k')) == 10);
}

TEST_CASE("buttons of RB boxes are numbered by their place", "[unit]") {
    const auto places = [](char product, char model) {
        std::string all;
        for (int key = 1; key <= 8; ++key)
            all += fmt::format("{}", xid_button({product, model, '2'}, key));
        return all;
    };
    CHECK(places('2', '1') == "12234578"); // 530: keys 1, 3, 4, 5 and 6 exist
    CHECK(places('2', '2') == "12345678");
    CHECK(places('2', '3') == "45236718");
    CHECK(places('2', '4') == "12345678");
    CHECK(places('0', '3') == "12345678");
    // A Riponda is laid out as the RB box of its model number.
    CHECK(places('5', '1') == "12234578");
    CHECK(places('5', '3') == "45236718");
    CHECK(places('S', '1') == "12345678");
}

TEST_CASE("an XID box is found at whatever speed it has, and timed by its clock", "[unit]") {
    XidModel model;
    model.mode = GENERATE(std::string("_xid0"), std::string("_xid1"));
    model.far.piece = [] { return std::size_t{3}; };
    XidBox box = model.box();
    CHECK(model.opened == 19200);
    CHECK(model.mode == "_xid0");
    CHECK_THAT(box.description().model, Catch::Contains("product 2, model 3, firmware 2, 19200 baud"));
    CHECK(box.description().has_clock);
    model.clock.wait_until(model.clock.now() + 1234us);
    box.begin();
    const SessionTime pressed = model.clock.now() + 40321us;
    model.press(pressed, 7, true);
    model.press(pressed + 60ms, 7, false);
    model.clock.wait_until(pressed + 500ms);
    std::array<ButtonChange, 4> changes;
    REQUIRE(box.poll(changes) == 2);
    CHECK(changes[0].button == 1); // of an RB-830
    CHECK(changes[0].is_down);
    CHECK(changes[0].at - changes[0].uncertainty <= pressed);
    CHECK(changes[0].at + changes[0].uncertainty >= pressed);
    CHECK(changes[0].uncertainty < 10ms);
    CHECK_FALSE(changes[1].is_down);
}

TEST_CASE("an XID box whose firmware tells no time is timed by when its presses are fetched", "[unit]") {
    XidModel model;
    model.firmware = "1";
    XidBox box = model.box();
    CHECK_FALSE(box.description().has_clock);
    box.begin();
    std::array<ButtonChange, 4> changes;
    CHECK(box.poll(changes) == 0);
    const SessionTime looked = model.clock.now(), pressed = looked + 3ms;
    model.press(pressed, 1, true);
    model.clock.wait_until(looked + 8ms);
    REQUIRE(box.poll(changes) == 1);
    CHECK(changes[0].at - changes[0].uncertainty <= pressed);
    CHECK(changes[0].at + changes[0].uncertainty >= pressed);
    CHECK(changes[0].uncertainty <= 10ms);
}

TEST_CASE("where no XID box answers it is said after a bounded time, and a lost one is lost", "[unit]") {
    XidModel model;
    SECTION("none") {
        model.baud = 300;
        CHECK_THROWS_WITH(model.box(), Catch::Contains("Nothing that speaks XID answers at /dev/ttyUSB0"));
        CHECK(model.clock.now() < SessionTime(22s));
    }
    SECTION("unplugged") {
        XidBox box = model.box();
        model.far.unplugged = true;
        std::array<ButtonChange, 4> changes;
        CHECK(box.poll(changes) == 0);
        CHECK(box.lost());
        CHECK_THROWS_WITH(box.begin(), Catch::Contains("unplugged by the test"));
    }
}

TEST_CASE("the lines of a StimTracker and a c-pod are raised by codes and stay until they are taken back",
          "[unit]") {
    XidModel model;
    model.baud = 115200;
    SECTION("of the second firmware") { model.product = "4"; }
    SECTION("a StimTracker of the first") {
        model.product = "S";
        model.firmware = "1";
    }
    XidTrigger trigger(model.far.port, model.opener(), model.clock);
    CHECK(trigger.name() == "Cedrus XID, product " + model.product + ", at /dev/ttyUSB0");
    CHECK(trigger.needs_code());
    // Pulses of its own are off, and what was raised before is taken back.
    CHECK(model.heard.ends_with(std::string("mp\0\0\0\0mh\0\0", 10)));
    CHECK(trigger.send({model.clock.now(), 0xA5, "onset"}));
    CHECK(model.heard.ends_with(std::string("mh\xA5\0", 4)));
    trigger.rest();
    CHECK(model.heard.ends_with(std::string("mh\xA5\0mh\0\0", 8)));
    model.far.unplugged = true;
    CHECK_FALSE(trigger.send({model.clock.now(), 1, ""}));
    CHECK_FALSE(trigger.fault().empty());
}

TEST_CASE("a box of the first firmware has its lines turned round, and takes bytes one by one", "[unit]") {
    XidModel model;
    model.firmware = "1";
    XidTrigger trigger(model.far.port, model.opener(), model.clock);
    CHECK(model.heard.ends_with(std::string("a10ah\xFF\0", 7)));
    const SessionTime before = model.clock.now();
    CHECK(trigger.send({before, 0x01, ""}));
    CHECK(model.heard.ends_with(std::string("ah\xFE\0", 4)));
    CHECK(model.clock.now() - before >= 4ms);
}

TEST_CASE("only what is a whole packet is one: each bit and byte of its head counts", "[unit]") {
    const auto keys_in = [](const std::string& bytes) {
        XidParser parser;
        parser.feed(bytes);
        int keys = 0;
        while (parser.next())
            ++keys;
        return keys;
    };
    for (int info = 0; info < 256; ++info)
        CHECK(keys_in(packet('k', {info, 0, 0, 0, 0})) == ((info & 0x0C) == 0 ? 1 : 0));
    for (int state = 0; state < 256; ++state) {
        // Behind what is none, the next is found.
        CHECK(keys_in(packet('o', {1, 2, state, 0, 0, 0, 0, 0})) ==
              (state == '0' || state == '1' || state == 'k' ? 1 : 0));
        CHECK(keys_in(std::string(1, static_cast<char>(state)) + packet('k', {0x30, 1, 2, 3, 4})) == 1);
    }
    // None is known before it is whole.
    for (const std::string& whole :
         {packet('k', {0x30, 1, 2, 3, 4}), packet('o', {1, 2, '1', 1, 2, 3, 4, 5})})
        for (std::size_t size = 1; size <= whole.size(); ++size)
            CHECK(keys_in(whole.substr(0, size)) == (size == whole.size() ? 1 : 0));
    XidParser parser;
    parser.feed(packet('o', {7, 2, '0', 1, 0, 0}));
    CHECK_FALSE(parser.next());
    parser.feed(std::string("\0\2", 2));
    const auto key = parser.next();
    REQUIRE(key);
    CHECK(key->port == 7);
    CHECK(key->key == 2);
    CHECK_FALSE(key->is_down);
    CHECK(key->ms == 1u);
}

TEST_CASE("of an answer only so many bytes are taken as it has", "[unit]") {
    XidModel model;
    XidLine line(model.far.port, model.opener(), model.clock);
    model.far.answer = nullptr;
    const SessionTime now = model.clock.now();
    for (int i = 0; i < 3; ++i)
        model.far.send(now + (i + 1) * 1ms, std::string(3, static_cast<char>('a' + i)));
    CHECK(line.ask("?", 5, 100ms) == "aaabb");
    std::array<char, 16> rest{};
    CHECK(line.read(rest, model.clock.now() + 10ms) == 1);
    CHECK(rest[0] == 'b');
    CHECK(line.ask("?", 5, 100ms) == "ccc"); // and no more came in time
}
