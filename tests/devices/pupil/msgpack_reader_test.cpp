#include "devices/pupil/msgpack_reader.h"

#include <catch2/catch.hpp>
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
