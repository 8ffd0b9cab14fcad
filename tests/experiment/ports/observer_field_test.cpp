#include "experiment/ports/observer_field.h"

#include <set>

#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::test;

namespace {

std::vector<ObserverFieldSettings> fields_of(std::string_view more) {
    const ReadText read(minimal_protocol, more);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return read.protocol->observer_fields;
}

constexpr std::string_view field_kinds = R"(
[[observer_field]]
id = "age"
[[observer_field]]
id = "handedness"
[[observer_field]]
id = "glasses"
title = "Dioptres of the glasses"
kind = "number"
min = -20
required = false
[[observer_field]]
id = "job"
)";

} // namespace

TEST_CASE("standard fields know their kind, title, limits and choices; others are texts", "[unit]") {
    const auto fields = fields_of(field_kinds);
    REQUIRE(fields.size() == 4);
    CHECK(fields[0].kind == FieldKind::number);
    CHECK(fields[0].title == "Age in years");
    CHECK(fields[0].max == 120.0);
    CHECK(fields[1].kind == FieldKind::choice);
    CHECK(fields[1].choices == std::vector<std::string>{"left", "right", "ambidextrous"});
    CHECK(fields[3].kind == FieldKind::text);
    CHECK(fields[3].title == "job");
    const auto own = fields_of("[[observer_field]]\nid = \"sex\"\nchoices = [\"f\", \"m\"]\n"
                               "[[observer_field]]\nid = \"age\"\nkind = \"text\"\n");
    CHECK(own[0].choices.size() == 2);
    CHECK(own[1].kind == FieldKind::text);
}

TEST_CASE("a scale has the numbers from 1 to its steps, and fields are sorted by when they are asked",
          "[unit]") {
    const auto fields =
        fields_of("[[observer_field]]\nid = \"tired\"\nkind = \"scale\"\nsteps = 5\nwhen = \"end\"\n"
                  "[[observer_field]]\nid = \"age\"\n"
                  "[[observer_field]]\nid = \"bored\"\nkind = \"scale\"\nwhen = \"end\"\n");
    REQUIRE(fields.size() == 3);
    CHECK(fields[0].choices == std::vector<std::string>{"1", "2", "3", "4", "5"});
    CHECK(fields[2].choices.size() == 7);
    CHECK_FALSE(fault_of(fields[0], "5"));
    for (const char* wrong : {"0", "6", "2.5", "five"})
        CHECK(fault_of(fields[0], wrong));
    CHECK(moments_asked(fields) == std::vector<std::string>{"end", "begin"});
    const auto at_end = fields_asked(fields, "end");
    REQUIRE(at_end.size() == 2);
    CHECK(at_end[1].id == "bored");
}

TEST_CASE("when a field is asked is checked, and what only scales have", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[observer_field]]\nid = \"a\"\nwhen = \"later\"\n"
                        "[[observer_field]]\nid = \"b\"\nwhen = \"block:none\"\n"
                        "[[observer_field]]\nid = \"c\"\nends = [\"x\", \"y\"]\n"
                        "[[observer_field]]\nid = \"d\"\nkind = \"scale\"\nends = [\"x\"]\n");
    CHECK_FALSE(read.protocol);
    CHECK(read.diagnostics.error_count() == 4);
}

TEST_CASE("a value stands in a field if it is of its kind, within its limits, or one of its choices",
          "[unit]") {
    const auto fields = fields_of(field_kinds);
    for (const char* right : {"31", "0", "120", "31.5"})
        CHECK_FALSE(fault_of(fields[0], right));
    for (const char* wrong : {"", "-1", "121", "31 years", "3,5", "nan", "inf", "1e999", "thirty"})
        CHECK(fault_of(fields[0], wrong));
    CHECK_FALSE(fault_of(fields[1], "left"));
    for (const char* wrong : {"", "Left", "both"})
        CHECK(fault_of(fields[1], wrong));
    CHECK_FALSE(fault_of(fields[2], ""));
    CHECK(fault_of(fields[2], "-20.5"));
    CHECK_FALSE(fault_of(fields[3], "Bäcker 面包师"));
    CHECK(trimmed(" \t31\r\n") == "31");
    CHECK(trimmed("  ").empty());
}

TEST_CASE("what a simulated observer says depends on the seed, and is never at fault", "[unit]") {
    auto fields = fields_of(field_kinds);
    ObserverFieldSettings narrow{"small", "", FieldKind::number, {}, 0.2, 0.4, true, ""};
    ObserverFieldSettings large{"large", "", FieldKind::number, {}, 1000.0, {}, true, ""};
    ObserverFieldSettings low{"low", "", FieldKind::number, {}, {}, -5.5, true, ""};
    fields.insert(fields.end(), {narrow, large, low});
    std::set<std::string> ages;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        for (const ObserverFieldSettings& field : fields) {
            CAPTURE(field.id, seed);
            CHECK_FALSE(fault_of(field, simulated_value(field, seed)));
            CHECK(simulated_value(field, seed) == simulated_value(field, seed));
        }
        ages.insert(simulated_value(fields[0], seed));
    }
    CHECK(ages.size() > 10);
}

TEST_CASE("faults of observer fields are found where they stand", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[observer_field]]\nid = \"a b\"\n"
                        "[[observer_field]]\nid = \"x\"\nkind = \"choice\"\n"
                        "[[observer_field]]\nid = \"x\"\nmin = 3\n"
                        "[[observer_field]]\nid = \"n\"\nkind = \"number\"\nmin = 3\nmax = 2\n"
                        "[[observer_field]]\nid = \"t\"\nchoices = [\"a\"]\n"
                        "[[observer_field]]\nid = \"c\"\nkind = \"choice\"\n"
                        "choices = [\"a\", \"a\"]\n");
    CHECK_FALSE(read.protocol);
    std::string all;
    for (const std::string& line : read.lines())
        all += line + "\n";
    INFO(all);
    CHECK(read.diagnostics.error_count() == 7);
    for (const char* found : {"13:6: ", "16:8: ", "18:6: ", "19:7: ", "23:7: ", "27:11: ", "31:11: "})
        CHECK(all.find(found) != std::string::npos);
}

TEST_CASE("what an observer filled in is read back in its order, and can be replaced", "[unit]") {
    const test::TemporaryFolder root;
    const auto session = testing::make_session(root.path(), testing::example_header());
    const std::vector<RecordedObserverField> fields{{"age", "Alter", "31"}, {"name", "שם", "أحمد 王"}};
    {
        SessionStore store(session / "session.sqlite", testing::patient());
        store.observer_fields({{"age", "Alter", "13"}, {"sex", "Sex", "female"}});
        store.observer_fields(fields);
        store.close();
    }
    CHECK(SessionRecord(session).observer_fields() == fields);
    CHECK(SessionRecord(session).damages().empty());
    // What is filled in later replaces nothing but itself.
    const RecordedObserverField guess{"guess", "Guess", "none", "end", SessionTime(std::chrono::seconds(9))},
        better{"guess", "Guess", "gloss", "end", SessionTime(std::chrono::seconds(10))};
    {
        SessionStore store(session / "session.sqlite", testing::patient());
        store.observer_fields({guess});
        store.observer_fields({better});
        store.close();
    }
    std::vector<RecordedObserverField> all = fields;
    all.push_back(better);
    CHECK(SessionRecord(session).observer_fields() == all);
}
