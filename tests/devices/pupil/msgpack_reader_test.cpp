#include "devices/pupil/msgpack_reader.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace overt;

namespace {

std::string packed(const nlohmann::json& value) {
    std::string bytes;
    nlohmann::json::to_msgpack(value, bytes);
    return bytes;
}

/// What the reader makes of bytes, as the library would have it.
nlohmann::json read_any(MsgpackReader& reader, const nlohmann::json& like) {
    if (like.is_array()) {
        nlohmann::json array = nlohmann::json::array();
        const auto count = reader.begin_array();
        REQUIRE(count == like.size());
        for (const nlohmann::json& each : like)
            array.push_back(read_any(reader, each));
        return array;
    }
    if (like.is_object()) {
        nlohmann::json object = nlohmann::json::object();
        CHECK(reader.each_entry([&](std::string_view key) {
            object[std::string(key)] = read_any(reader, like.at(std::string(key)));
            return true;
        }));
        return object;
    }
    if (like.is_string())
        return std::string(reader.text().value());
    if (like.is_boolean())
        return reader.boolean().value();
    if (like.is_number())
        return reader.number().value();
    reader.skip();
    return nullptr;
}

nlohmann::json everything() {
    nlohmann::json many = nlohmann::json::array();
    for (int i = 0; i < 70'000; ++i)
        many.push_back(i % 3);
    nlohmann::json keys = nlohmann::json::object();
    for (int i = 0; i < 20; ++i)
        keys["key " + std::to_string(i)] = i * 1.5;
    return {{"small", {0, 1, 127, -1, -32}},
            {"whole",
             {128, 255, 256, 65535, 65536, 4294967295u, 4294967296u, -33, -128, -129, -32768, -32769,
              -2147483648LL, -2147483649LL}},
            {"real", {0.5, -1e300, 5000.123456789}},
            {"texts",
             {"", "gaze.3d.01.", std::string(31, 'a'), std::string(32, 'b'), std::string(300, 'c'),
              std::string(70'000, 'd')}},
            {"flags", {true, false, nullptr}},
            {"many", many},
            {"keys", keys}};
}

} // namespace

TEST_CASE("every kind of value of MessagePack is read as another program wrote it", "[unit]") {
    const nlohmann::json all = everything();
    const std::string bytes = packed(all);
    MsgpackReader reader(bytes);
    CHECK(read_any(reader, all) == all);
    CHECK_FALSE(reader.failed());
    reader.skip();
    CHECK(reader.failed());
}

TEST_CASE("a value of MessagePack of another kind is passed over with all that is in it", "[unit]") {
    std::string bytes = packed(everything());
    bytes += packed(nlohmann::json::binary({1, 2, 3}));
    bytes += packed(nlohmann::json::binary({1, 2, 3, 4}, 7)); // an extension
    bytes += packed(42);
    MsgpackReader reader(bytes);
    CHECK_FALSE(reader.number());
    CHECK_FALSE(reader.text());
    CHECK_FALSE(reader.begin_map());
    CHECK(reader.number() == 42.0);
    CHECK_FALSE(reader.failed());
    MsgpackReader again(bytes);
    CHECK_FALSE(again.begin_array());
    CHECK_FALSE(again.boolean());
    again.skip();
    CHECK(again.number() == 42.0);
}

TEST_CASE("values nested a million deep and counts that nothing stands behind exhaust nothing", "[unit]") {
    const std::string nested(1'000'000, '\x91');
    MsgpackReader reader(nested);
    reader.skip();
    CHECK(reader.failed());
    for (const std::string_view promise :
         {std::string_view("\xdd\xff\xff\xff\xff", 5), std::string_view("\xdf\xff\xff\xff\xff", 5),
          std::string_view("\xdb\xff\xff\xff\xff", 5), std::string_view("\xc6\xff\xff\xff\xff", 5),
          std::string_view("\xc9\xff\xff\xff\xff\x01", 6), std::string_view("\xcb\x01", 2),
          std::string_view("\xc1", 1), std::string_view()}) {
        MsgpackReader hostile(promise);
        hostile.skip();
        CHECK(hostile.failed());
        CHECK_FALSE(hostile.number());
        MsgpackReader counted(promise);
        counted.each_entry([](std::string_view) { return false; });
        CHECK(counted.failed());
    }
}

TEST_CASE("a map of MessagePack whose keys are no texts is no map that is read", "[unit]") {
    const std::string bytes("\x82\x01\x02\xa1k\x03", 6);
    MsgpackReader reader(bytes);
    std::optional<double> value;
    CHECK(reader.each_entry([&](std::string_view key) {
        if (key == "k")
            value = reader.number();
        return key == "k";
    }));
    CHECK(value == 3.0);
}

TEST_CASE("each head of MessagePack is of its kind, up to the bytes beside those of the next", "[unit]") {
    const auto of = [](std::initializer_list<int> bytes, std::size_t more = 0) {
        std::string all;
        for (const int byte : bytes)
            all += static_cast<char>(byte);
        return all + std::string(more, 'x');
    };
    // By its head alone: what it is, its number or count, and how much of what follows it takes.
    const auto read = [](const std::string& bytes) -> std::string {
        const std::string behind = bytes + "\x2a"; // the number 42
        const auto with = [&](const auto& ask) -> std::string {
            MsgpackReader reader(behind);
            const auto found = ask(reader);
            return found ? fmt::format("{} then {}", *found, reader.number().value_or(-1.0)) : std::string();
        };
        if (std::string map = with([](MsgpackReader& reader) { return reader.begin_map(); }); !map.empty())
            return "map " + map;
        if (std::string array = with([](MsgpackReader& reader) { return reader.begin_array(); });
            !array.empty())
            return "array " + array;
        if (std::string text = with([](MsgpackReader& reader) -> std::optional<std::size_t> {
                const auto found = reader.text();
                return found ? std::optional(found->size()) : std::nullopt;
            });
            !text.empty())
            return "text " + text;
        if (std::string flag = with([](MsgpackReader& reader) { return reader.boolean(); }); !flag.empty())
            return "flag " + flag;
        if (std::string number = with([](MsgpackReader& reader) { return reader.number(); }); !number.empty())
            return "number " + number;
        MsgpackReader reader(behind);
        reader.skip();
        return fmt::format("passed over then {}", reader.number().value_or(-1.0));
    };
    CHECK(read(of({0x00})) == "number 0 then 42");
    CHECK(read(of({0x7F})) == "number 127 then 42");
    CHECK(read(of({0x80})) == "map 0 then 42");
    CHECK(read(of({0x8F})) == "map 15 then 42");
    CHECK(read(of({0x90})) == "array 0 then 42");
    CHECK(read(of({0x9F})) == "array 15 then 42");
    CHECK(read(of({0xA0})) == "text 0 then 42");
    CHECK(read(of({0xBF}, 31)) == "text 31 then 42");
    CHECK(read(of({0xC0})) == "passed over then 42");
    CHECK(read(of({0xC1})) == "passed over then -1"); // never used
    CHECK(read(of({0xC2})) == "flag false then 42");
    CHECK(read(of({0xC3})) == "flag true then 42");
    CHECK(read(of({0xC4, 3}, 3)) == "passed over then 42");
    CHECK(read(of({0xC5, 1, 2}, 258)) == "passed over then 42");
    CHECK(read(of({0xC6, 0, 0, 1, 2}, 258)) == "passed over then 42");
    CHECK(read(of({0xC7, 3}, 4)) == "passed over then 42"); // and its type
    CHECK(read(of({0xC8, 1, 2}, 259)) == "passed over then 42");
    CHECK(read(of({0xC9, 0, 0, 1, 2}, 259)) == "passed over then 42");
    CHECK(read(of({0xCA, 0x3F, 0xC0, 0, 0})) == "number 1.5 then 42");
    CHECK(read(of({0xCB, 0xBF, 0xF8, 0, 0, 0, 0, 0, 0})) == "number -1.5 then 42");
    CHECK(read(of({0xCC, 0xFF})) == "number 255 then 42");
    CHECK(read(of({0xCD, 1, 2})) == "number 258 then 42");
    CHECK(read(of({0xCE, 0, 1, 2, 3})) == "number 66051 then 42");
    CHECK(read(of({0xCF, 0, 0, 0, 0, 0, 1, 2, 3})) == "number 66051 then 42");
    CHECK(read(of({0xD0, 0xFF})) == "number -1 then 42");
    CHECK(read(of({0xD1, 0xFF, 0xFE})) == "number -2 then 42");
    CHECK(read(of({0xD2, 0xFF, 0xFF, 0xFF, 0xFD})) == "number -3 then 42");
    CHECK(read(of({0xD3, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFC})) == "number -4 then 42");
    for (int i = 0; i < 5; ++i)
        CHECK(read(of({0xD4 + i}, (1u << i) + 1)) == "passed over then 42");
    CHECK(read(of({0xD9, 200}, 200)) == "text 200 then 42");
    CHECK(read(of({0xDA, 1, 2}, 258)) == "text 258 then 42");
    CHECK(read(of({0xDB, 0, 0, 1, 2}, 258)) == "text 258 then 42");
    CHECK(read(of({0xDC, 1, 2})) == "array 258 then 42");
    CHECK(read(of({0xDD, 0, 1, 2, 3})) == "array 66051 then 42");
    CHECK(read(of({0xDE, 1, 2})) == "map 258 then 42");
    CHECK(read(of({0xDF, 0, 1, 2, 3})) == "map 66051 then 42");
    CHECK(read(of({0xE0})) == "number -32 then 42");
    CHECK(read(of({0xFF})) == "number -1 then 42");
    CHECK(read(of({0x92, 0x01, 0x02})) == "array 2 then 1");
}
