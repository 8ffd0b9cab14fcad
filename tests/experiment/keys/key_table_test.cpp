#include "experiment/keys/key_table.h"

#include <catch2/catch.hpp>

#include "experiment/keys/key_walk.h"

using namespace overt;

namespace {

enum class Mood : std::uint8_t { calm, wide_awake };
enum class Size { small, large };

} // namespace

namespace overt {
template <> inline constexpr auto names_of<Mood> = enum_names<Mood>("calm", "wide-awake");
} // namespace overt

namespace {

struct Room {
    double height_m = 2.5;
    std::string colour = "white \"as\" snow";
    Mood mood = Mood::wide_awake;
    std::optional<Mood> before = {};
    Size size = Size::large;
};

struct Chair {
    std::string id;
    int legs = 4;
    std::optional<glm::dvec3> place;
};

struct House {
    int doors = 1;
    Room room;
    std::vector<Chair> chairs;
};

constexpr std::string_view sizes[] = {"small", "large"};

Section house() {
    return {"house", SectionHome::root<House>(), {{"doors", &House::doors, range(1, 9), "Ways in."}}};
}

Section room() {
    return {"room",
            &House::room,
            {{"height_m", &Room::height_m, {.low = 1, .unit = "m"}, "To the ceiling."},
             {"colour", &Room::colour, "Of the walls."},
             {"mood", &Room::mood, "Of who lives there."},
             {"before", &Room::before, left_out("unknown"), "Once."},
             {"size", &Room::size, one_of(sizes), "As it feels."}}};
}

Section chair() {
    return {"chair",
            &House::chairs,
            {{"id", &Chair::id, required(), "Its name."}, {"legs", &Chair::legs, "Their number."}},
            {},
            {{"where", {}, {{"point", &Chair::place, left_out("anywhere"), "x, y, z."}}}}};
}

struct ReadHouse {
    explicit ReadHouse(std::string_view text) {
        const KeyTable table({house(), room(), chair()}, "include");
        const TomlFile toml = parse_toml(text, "h.toml", diagnostics);
        KeyWalk(table, "h.toml", places, faulty, diagnostics).read(toml, values);
    }
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(
                fmt::format("{}:{}: {}", finding.place.line, finding.place.column, finding.message));
        return lines;
    }
    Diagnostics diagnostics;
    KeyPlaces places;
    KeyPaths faulty;
    House values;
};
using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("an enumeration's names are as many as its values", "[unit]") {
    CHECK(name_of(Mood::wide_awake) == "wide-awake");
    static_assert(NamedEnum<Mood> && !NamedEnum<Size>);
    static_assert(is_enumerator<Mood, Mood::wide_awake>() && !is_enumerator<Mood, static_cast<Mood>(2)>());
    static_assert(is_enumerator<Size, Size::small>() && !is_enumerator<Size, static_cast<Size>(2)>());
}

TEST_CASE("a walk through a table puts each value where it belongs, and notes where it stands", "[unit]") {
    const ReadHouse read(
        "[house]\ndoors = 2\n[room]\nheight_m = 3\nmood = \"calm\"\nbefore = \"wide-awake\"\n"
        "size = \"small\"\n[[chair]]\nid = \"a\"\n[[chair]]\nid = \"b\"\nlegs = 3\n"
        "where = { point = [1, 2.5, 0] }\n");
    CHECK(read.lines() == Lines{});
    CHECK(read.values.doors == 2);
    CHECK(read.values.room.height_m == 3.0);
    CHECK(read.values.room.mood == Mood::calm);
    CHECK(read.values.room.before == Mood::wide_awake);
    CHECK(read.values.room.size == Size::small);
    REQUIRE(read.values.chairs.size() == 2);
    CHECK(read.values.chairs[0].legs == 4);
    CHECK(read.values.chairs[1].legs == 3);
    CHECK(read.values.chairs[1].place == glm::dvec3(1.0, 2.5, 0.0));
    CHECK(read.places.of("chair[1].legs") == Place{12, 8});
    CHECK(read.places.of("chair[1].where.point").line == 13);
    CHECK_FALSE(read.places.is_written("chair[0].legs"));
}

TEST_CASE("all that is wrong by the table is found, and told with what mends it", "[unit]") {
    const ReadHouse read("doors = 3\n[house]\ndoors = 12\ninclude = \"x\"\n[rom]\n[room]\nmood = \"tense\"\n"
                         "legs = 4\ncolor = \"red\"\n[[chair]]\nlegs = \"four\"\nwhere = 3\n[chairs]\n");
    CHECK(read.lines() ==
          Lines{"1:1: key \"doors\" stands outside all sections",
                "3:9: doors: 12 is out of range, which is 1 … 9", "4:1: unknown key \"include\" in [house]",
                "5:2: unknown section [rom]", "7:8: mood: unknown value \"tense\"",
                "8:1: unknown key \"legs\" in [room]", "9:1: unknown key \"color\" in [room]",
                "10:1: [[chair]] has no \"id\"", "11:8: legs: expected a whole number, found a text",
                "12:9: where: expected a table, found a whole number", "13:2: unknown section [chairs]"});
    const auto findings = read.diagnostics.findings();
    CHECK(findings[0].hint == "write it below the heading [house]");
    CHECK(findings[2].hint == "\"include\" stands before the first section");
    CHECK(findings[5].hint == "\"legs\" belongs to [[chair]]");
    CHECK(findings[6].hint == "did you mean \"colour\"?");
    CHECK(findings[7].hint == "Its name.");
    CHECK(read.faulty == KeyPaths{"house.doors", "room.mood", "chair[0].id", "chair[0].legs"});
    CHECK(read.values.doors == 1);
}

TEST_CASE("a section where a list belongs, and the reverse, are told by their brackets", "[unit]") {
    CHECK(ReadHouse("chair = 1\n[[room]]\n").lines() ==
          Lines{"1:9: chair: expected a list of sections", "2:1: room: expected a section, found a list"});
    CHECK(ReadHouse("chair = [1]\n").lines() ==
          Lines{"1:10: chair: expected a section, found a whole number"});
    // What is lacking may lie in a line that was passed over.
    CHECK(ReadHouse("[[chair]]\nid = nobody\n").lines().size() == 1);
}

TEST_CASE("a default is told as it is written, and not where being left out means something else", "[unit]") {
    const auto text = [](const Section& section, std::size_t key) {
        return section.keys.at(key).default_text();
    };
    CHECK(text(house(), 0) == "1");
    CHECK(text(room(), 0) == "2.5");
    CHECK(text(room(), 1) == "\"white \\\"as\\\" snow\"");
    CHECK(text(room(), 2) == "\"wide-awake\"");
    CHECK(text(room(), 3).empty());
    CHECK(text(room(), 4) == "\"large\"");
    CHECK(text(chair(), 0).empty());
    CHECK(chair().tables[0].keys[0].default_text().empty());
}

TEST_CASE("a key gives its member only as what it is", "[unit]") {
    const Room room_of{.height_m = 4.0};
    const Section section = room();
    REQUIRE(section.keys[0].get_if<double>(&room_of));
    CHECK(*section.keys[0].get_if<double>(&room_of) == 4.0);
    CHECK(section.keys[0].get_if<int>(&room_of) == nullptr);
    CHECK(section.keys[2].get_if<Mood>(&room_of) == &room_of.mood);
}
