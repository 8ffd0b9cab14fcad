#include "experiment/design/task_trials.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/design/schedule.h"
#include "experiment/design/trial_plan.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view two_slots = R"([protocol]
name = "pairs"
[view]
width_px = 200
height_px = 200
[[object]]
id = "vase"
shipped = "muse"
[[object]]
id = "bust"
shipped = "scholar"
[[material]]
id = "g1"
kind = "rough-conductor"
[[material]]
id = "g2"
kind = "rough-conductor"
[[material]]
id = "g3"
kind = "rough-conductor"
[[slot]]
id = "left"
right_deg = -5
[[slot]]
id = "right"
right_deg = 5
[[task]]
id = "glossier"
question = "Which is glossier?"
slots = ["left", "right"]
)";

/// Reads a protocol and the table list.tsv beside it.
struct ReadWithTable {
    explicit ReadWithTable(const std::string& text, const std::string& table = {})
        : protocol(read_protocol_text(text, "p.toml", shipped_names, diagnostics, {{"list.tsv", table}})) {}

    /// "file:line:column: message" of each finding.
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(fmt::format("{}:{}:{}: {}", finding.file, finding.place.line,
                                        finding.place.column, finding.message));
        return lines;
    }
    Diagnostics diagnostics;
    std::optional<Protocol> protocol;
};

Protocol sound(const std::string& text, const std::string& table = {}) {
    ReadWithTable read(text, table);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

std::string with(std::string_view more) { return std::string(two_slots) + std::string(more); }

std::string level_of_trial(const Trial& trial, std::string_view factor) {
    const auto found = std::ranges::find(trial.levels, factor, &TrialLevel::factor);
    return found == trial.levels.end() ? "" : found->level;
}

} // namespace

TEST_CASE("a rule's trials have each pair as often as it is asked for, on both sides", "[unit]") {
    const Protocol protocol = sound(
        with("trials = { rule = \"pairs\", of = \"material\", side = \"crossed\" }\nrepetitions = 2\n"));
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 7);
    // 3 pairs, 2 objects, 2 sides, 2 times.
    REQUIRE(schedule.trials.size() == 24);
    std::map<std::pair<Stimulus, Stimulus>, int> pairs;
    for (const Trial& trial : schedule.trials) {
        REQUIRE(trial.shown_count() == 2);
        const auto [left, left_slot] = trial.shown(0);
        const auto [right, right_slot] = trial.shown(1);
        REQUIRE(left_slot == 0);
        REQUIRE(right_slot == 1);
        REQUIRE(left.object == right.object);
        REQUIRE(left.material != right.material);
        REQUIRE(level_of_trial(trial, "side") == (left.material < right.material ? "left" : "right"));
        ++pairs[{left, right}];
    }
    CHECK(pairs.size() == 12);
    for (const auto& [pair, count] : pairs)
        CHECK(count == 2);
}

TEST_CASE("what is drawn is each observer's own, the same from the same seed, or everyone's", "[unit]") {
    const std::string rule = "trials = { rule = \"pairs\", of = \"material\", draw = 3";
    const std::string no_limit = "[schedule]\nmax_object_run = 0\n";
    const Protocol own = sound(with(rule + " }\n" + no_limit)),
                   common = sound(with(rule + ", per = \"everyone\" }\n" + no_limit));
    std::set<std::vector<Stimulus>> own_lists, common_lists;
    for (int number = 1; number <= 20; ++number) {
        const auto list_of = [&](const Protocol& protocol) {
            std::vector<Stimulus> list;
            for (const BlockPlan& plan : block_plans(protocol, number, 5))
                for (const Trial& trial : plan.trials)
                    for (const PlacedStimulus& shown : trial.all_shown())
                        list.push_back(shown.stimulus);
            return list;
        };
        REQUIRE(list_of(own).size() == 6);
        CHECK(list_of(own) == list_of(own));
        own_lists.insert(list_of(own));
        common_lists.insert(list_of(common));
    }
    CHECK(own_lists.size() > 10);
    CHECK(common_lists.size() == 1);
}

TEST_CASE("a table's rows are trials with slots, factors, correct answers and repeats", "[unit]") {
    const std::string table = "object\tleft.material\tright.material\tcorrect\tease\trepeat\n"
                              "vase\tg1\tg2\tleft\t0.5\t2\n"
                              "bust\tg3\tg1\tright\t1\t\n";
    const Protocol protocol = sound(with("trials = \"list.tsv\"\n"), table);
    REQUIRE(protocol.included.size() == 1);
    CHECK(protocol.included[0].name == "list.tsv");
    const std::vector<Trial> trials = trials_of(protocol, 1);
    REQUIRE(trials.size() == 3);
    CHECK(trials[0].shown(0) == PlacedStimulus{{0, 0}, 0});
    CHECK(trials[0].shown(1) == PlacedStimulus{{0, 1}, 1});
    CHECK(trials[0].correct == "left");
    CHECK(trials[0].levels == std::vector<TrialLevel>{{"ease", "0.5"}});
    CHECK(trials[1].shown(1) == trials[0].shown(1));
    CHECK(trials[2].shown(0) == PlacedStimulus{{1, 2}, 0});
    CHECK(trials[2].correct == "right");
}

TEST_CASE("a slot's column may name a stimulus by its ids, and an empty one leaves it empty", "[unit]") {
    const Protocol protocol =
        sound(with("trials = \"list.tsv\"\n"), "left;right\r\nvase/g1;bust/g3\r\n;vase/g2\r\n");
    const std::vector<Trial> trials = trials_of(protocol, 1);
    REQUIRE(trials.size() == 2);
    CHECK(trials[0].shown(1) == PlacedStimulus{{1, 2}, 1});
    REQUIRE(trials[1].shown_count() == 1);
    CHECK(trials[1].shown(0) == PlacedStimulus{{0, 1}, 1});
}

TEST_CASE("a table says for each trial how long a step lasts, or leaves it as it is", "[unit]") {
    const std::string steps =
        "trials = \"list.tsv\"\nsteps = [{ blank = 0.5 }, { show = [\"left\", \"right\"], for_s = 1 }, "
        "{ blank = 1, id = \"gap\" }]\n";
    const Protocol protocol =
        sound(with(steps), "left;right;blank_s;gap_s\nvase/g1;vase/g2;0,25;2\nvase/g1;vase/g2;;3\n");
    const std::vector<Trial> trials = trials_of(protocol, 1);
    REQUIRE(trials.size() == 2);
    const TrialPlan first = plan_trial(protocol, 1, trials[0], false),
                    second = plan_trial(protocol, 1, trials[1], false);
    CHECK(first.steps[0].drawn_s == 0.25);
    CHECK(first.steps[0].refreshes == 30);
    CHECK(first.steps[1].drawn_s == 1.0);
    CHECK(first.steps[2].drawn_s == 2.0);
    CHECK(second.steps[0].drawn_s == 0.5);
    CHECK(second.steps[2].refreshes == 360);
    CHECK(ReadWithTable(with(steps), "left,right,gap_s\nvase/g1,vase/g2,0\nvase/g1,vase/g2,long\n").lines() ==
          std::vector<std::string>{"list.tsv:2:17: \"0\" is no duration of a step",
                                   "list.tsv:3:17: \"long\" is no duration of a step"});
}

TEST_CASE("all that is wrong in a table of trials is found at once, at its line and column", "[unit]") {
    const auto lines = [](const std::string& table) {
        return ReadWithTable(with("trials = \"list.tsv\"\n"), table).lines();
    };
    using Lines = std::vector<std::string>;
    CHECK(lines("object,left.material,middle.material,left.colour\nvaze,g1,g1,g1\nbust,g9,g1,g1\n") ==
          Lines{"list.tsv:1:22: the task has no slot \"middle\"",
                "list.tsv:1:38: there is no list \"colour\"", "list.tsv:2:1: there is no object \"vaze\"",
                "list.tsv:3:6: there is no material \"g9\""});
    CHECK(lines("objct,material\nvase,g1\n") ==
          Lines{"list.tsv:1:1: unknown column \"objct\"",
                "list.tsv:2:1: nothing says which object slot \"left\" shows, of 2",
                "list.tsv:2:1: nothing says which object slot \"right\" shows, of 2"});
    CHECK(lines("left,right,block,repeat\nvase/g1/overcast/x/y/z,vase/g1,one,-1\n,,,1\n").size() == 7);
    CHECK(lines("left,right,left.material\nvase/g1,vase/g1,g2\n").size() == 1);
    CHECK(lines("left,right,side\nvase/g1,vase/g2,a\n") ==
          Lines{"list.tsv:1:12: \"side\" is the name of a factor that every trial has"});
    ReadWithTable missing(with("trials = \"other.tsv\"\n"));
    CHECK(missing.lines() ==
          Lines{"p.toml:31:10: trials \"other.tsv\": it is not among the texts that are kept"});
    ReadWithTable outside(with("trials = \"../other.tsv\"\n"));
    CHECK(outside.lines() ==
          Lines{"p.toml:31:10: trials \"../other.tsv\": leads out of the protocol's folder"});
}

TEST_CASE("what a rule cannot give is said at its key, with all that is wrong", "[unit]") {
    const auto lines = [](std::string_view rule) { return ReadWithTable(with(rule)).lines(); };
    using Lines = std::vector<std::string>;
    CHECK(lines("trials = { rule = \"pairs\", of = \"materials\" }\n") ==
          Lines{"p.toml:31:33: there is no factor \"materials\""});
    CHECK(
        lines("trials = { rule = \"pairs\" }\n") ==
        Lines{"p.toml:31:10: nothing says in which factor the stimuli of a trial differ: object and material "
              "differ"});
    CHECK(lines("trials = { rule = \"pairs\", of = \"light\" }\n") ==
          Lines{"p.toml:31:33: the factor \"light\" has 1 level, so that nothing can differ in it"});
    CHECK(lines("trials = { rule = \"triads\", of = \"material\" }\n") ==
          Lines{"p.toml:31:19: the rule \"triads\" fills 3 slots, and the task has 2 (left, right)"});
    CHECK(lines("trials = { rule = \"pairs\", of = \"material\", draw = 7 }\n") ==
          Lines{"p.toml:31:52: 7 trials are drawn, and the rule \"pairs\" gives 6 to draw from"});
    CHECK(lines("trials = { rule = \"pairs\", of = \"material\", standard = \"g1\", length = 3 }\n").size() ==
          2);
    CHECK(
        lines("trials = { rule = \"pairs\", of = \"material\" }\nrepetitions = 1000\n") ==
        Lines{
            "p.toml:31:19: the rule \"pairs\" gives 6000 trials; 2000 is the most that a session can hold"});
    CHECK(lines("trials = { rule = \"pears\", of = \"material\" }\n").size() == 1);
    CHECK(lines("trials = { of = \"material\" }\n").size() == 1);
    CHECK(lines("trials = { rule = \"standard\", of = \"material\", standard = \"g7\" }\n") ==
          Lines{"p.toml:31:59: material has no level \"g7\""});
    CHECK(lines("stimuli = \"once-per-object\"\ntrials = { rule = \"pairs\", of = \"material\" }\n").size() ==
          1);
}

TEST_CASE("limits, blocks and seeds go on with the trials of a rule", "[unit]") {
    const Protocol protocol = sound(with(R"(trials = { rule = "pairs", of = "material", side = "crossed" }
[schedule]
max_object_run = 1
[[block]]
id = "only"
objects = ["vase", "bust"]
repetitions = 2
)"));
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, seed);
        REQUIRE(schedule.trials.size() == 24);
        for (std::size_t i = 1; i < schedule.trials.size(); ++i)
            REQUIRE(schedule.trials[i].stimulus.object != schedule.trials[i - 1].stimulus.object);
    }
}

namespace {

constexpr std::string_view study_and_test = R"([protocol]
name = "memory"
[[object]]
id = "a"
shipped = "muse"
[[object]]
id = "b"
shipped = "muse"
[[object]]
id = "c"
shipped = "muse"
[[object]]
id = "d"
shipped = "muse"
[[object]]
id = "e"
shipped = "muse"
[[object]]
id = "f"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "learn"
question = "Learn."
[[task]]
id = "recognise"
question = "Seen?"
[[block]]
id = "study"
tasks = "learn"
draw = { of = "object", count = 3 }
[[block]]
id = "test"
tasks = "recognise"
draw = { of = "object", old = 2, new = 2, from = "study" }
)";

} // namespace

TEST_CASE("what an observer learned is old in the test, and what is new was not learned", "[unit]") {
    const Protocol protocol = sound(std::string(study_and_test));
    std::set<std::set<int>> lists;
    std::map<int, int> often;
    for (int number = 1; number <= 60; ++number) {
        const Schedule schedule = make_schedule(protocol, {"P", number}, 3);
        REQUIRE(schedule.trials.size() == 3 + 4);
        std::set<int> learned;
        for (const Trial& trial : schedule.trials) {
            const int object = trial.stimulus.object;
            if (trial.block == 0) {
                CHECK(learned.insert(object).second);
                CHECK(trial.levels.empty());
                ++often[object];
                continue;
            }
            REQUIRE(level_of_trial(trial, "seen") == (learned.contains(object) ? "old" : "new"));
            REQUIRE(trial.correct == level_of_trial(trial, "seen"));
        }
        CHECK(std::ranges::count(schedule.trials, "old", &Trial::correct) == 2);
        CHECK(std::ranges::count(schedule.trials, "new", &Trial::correct) == 2);
        lists.insert(learned);
        CHECK(make_schedule(protocol, {"P", number}, 3).trials == schedule.trials);
    }
    CHECK(lists.size() > 12); // of 20
    for (const auto& [object, count] : often)
        CHECK(std::abs(count - 30) < 16);
}

TEST_CASE("limits hold on what is old and new, and on the correct answer", "[unit]") {
    const Protocol protocol = sound(std::string(study_and_test) + "max_run = { seen = 1, correct = 1 }\n");
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, seed);
        for (std::size_t i = 4; i < schedule.trials.size(); ++i)
            REQUIRE(schedule.trials[i].correct != schedule.trials[i - 1].correct);
    }
    const Protocol sides = sound(with("trials = { rule = \"pairs\", of = \"material\", side = \"crossed\" }\n"
                                      "[schedule]\nmax_object_run = 0\nmax_run = { side = 1 }\n"));
    const Schedule schedule = make_schedule(sides, {"P", 1}, 1);
    for (std::size_t i = 1; i < schedule.trials.size(); ++i)
        REQUIRE(schedule.trials[i].levels != schedule.trials[i - 1].levels);
}

TEST_CASE("a draw that cannot be made is said at its key", "[unit]") {
    const auto lines = [](std::string_view from, std::string_view to) {
        std::string text(study_and_test);
        text.replace(text.find(from), from.size(), to);
        return ReadWithTable(text).lines();
    };
    using Lines = std::vector<std::string>;
    CHECK(lines("count = 3", "count = 7") ==
          Lines{"p.toml:33:33: 7 objects are drawn, of 6 that are listed"});
    CHECK(lines("old = 2", "old = 4") == Lines{"p.toml:37:31: 4 objects are drawn, of 3 that are old"});
    CHECK(lines("new = 2", "new = 4") == Lines{"p.toml:37:40: 4 objects are drawn, of 3 that are new"});
    CHECK(lines("from = \"study\"", "from = \"test\"") ==
          Lines{"p.toml:37:50: block \"test\" does not come before this one"});
    CHECK(lines("from = \"study\"", "from = \"studi\"") ==
          Lines{"p.toml:37:50: there is no block \"studi\""});
    CHECK(lines(", count = 3", "").size() == 2);
    CHECK(lines("{ of = \"object\", count", "{ of = \"objects\", count").size() == 2);
}

TEST_CASE("catch trials are the share that is asked for, marked, with their own answers", "[unit]") {
    const std::string text = with("trials = { rule = \"pairs\", of = \"material\", side = \"crossed\" }\n"
                                  "repetitions = 3\ncatch = { trials = \"list.tsv\", share = 0.1 }\n");
    const std::string table =
        "left,right,correct\nvase/g1,vase/g3,right\nvase/g3,vase/g1,left\nbust/g3,bust/g1,left\n";
    const Protocol protocol = sound(text, table);
    std::set<int> places;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, seed);
        // 36 pairs, and 4 of 40.
        REQUIRE(schedule.trials.size() == 40);
        int left = 0;
        for (const Trial& trial : schedule.trials) {
            if (trial.role == TrialRole::trial) {
                CHECK(trial.correct.empty());
                continue;
            }
            places.insert(trial.index);
            left += trial.correct == "left";
            CHECK(trial.correct == (trial.shown(0).stimulus.material == 2 ? "left" : "right"));
        }
        CHECK(std::ranges::count(schedule.trials, TrialRole::catch_trial, &Trial::role) == 4);
        CHECK(left >= 2);
        CHECK(left <= 3);
    }
    CHECK(places.size() > 25);
}

TEST_CASE("all trials of a block of practice are practice, whatever else they are", "[unit]") {
    const Protocol protocol =
        sound(std::string(study_and_test) + "[[block]]\nid = \"warm-up\"\npractice = true\n"
                                            "tasks = \"learn\"\nobjects = \"a\"\n");
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    REQUIRE(schedule.trials.size() == 8);
    for (const Trial& trial : schedule.trials)
        CHECK(trial.role == (trial.block == 2 ? TrialRole::practice : TrialRole::trial));
}

TEST_CASE("a search fills some places of a circle, and leaves the others empty", "[unit]") {
    std::string text(two_slots);
    text.erase(text.find("[[slot]]"));
    text += "[[slot]]\nid = \"ring\"\ncircle = 6\nradius_deg = 4\n[[task]]\nid = \"find\"\nquestion = \"Is "
            "there one?\"\n"
            "slots = \"ring\"\ntrials = { rule = \"search\", of = \"material\", target = \"g3\", set_sizes = "
            "[2, 6], "
            "absent = 0.5 }\n[schedule]\nmax_run = { target = 2, set_size = 3 }\n";
    const Protocol protocol = sound(text);
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 3);
    // 2 objects, 2 set sizes, with and without.
    REQUIRE(schedule.trials.size() == 8);
    for (const Trial& trial : schedule.trials) {
        const std::vector<PlacedStimulus> shown = trial.all_shown();
        CHECK(level_of_trial(trial, "set_size") == std::to_string(shown.size()));
        std::set<int> places, objects;
        int targets = 0;
        for (const PlacedStimulus& one : shown) {
            places.insert(one.slot);
            objects.insert(one.stimulus.object);
            targets += one.stimulus.material == 2;
            if (one.stimulus.material == 2)
                CHECK(level_of_trial(trial, "side") == protocol.slots[static_cast<std::size_t>(one.slot)].id);
        }
        CHECK(places.size() == shown.size());
        CHECK(objects.size() == 1);
        CHECK(targets == (trial.correct == "present" ? 1 : 0));
    }
}

TEST_CASE("a match is under another light than its sample", "[unit]") {
    std::string text(two_slots);
    text.replace(
        text.find("slots = [\"left\", \"right\"]"), 25,
        "slots = [\"centre\", \"left\", \"right\"]\ntrials = { rule = \"match\", sample = \"centre\", of = "
        "\"material\", differs = \"light\", side = \"crossed\" }");
    text += "[[slot]]\nid = \"centre\"\nup_deg = -3\n[[light]]\nid = \"hall\"\nprobe = "
            "\"gallery\"\n[[light]]\nid = \"cloudy\"\n";
    const std::vector<Trial> trials = trials_of(sound(text), 1);
    // 2 objects, 3 materials under 2 lights, the other light, 2 others, 2 sides.
    REQUIRE(trials.size() == 2 * 3 * 2 * 2 * 2);
    for (const Trial& trial : trials) {
        std::map<int, Stimulus> in_slot;
        for (const PlacedStimulus& shown : trial.all_shown())
            in_slot[shown.slot] = shown.stimulus;
        REQUIRE(in_slot.size() == 3);
        const Stimulus sample = in_slot[2], match = in_slot[trial.correct == "left" ? 0 : 1],
                       other = in_slot[trial.correct == "left" ? 1 : 0];
        CHECK(sample.material == match.material);
        CHECK(sample.light != match.light);
        CHECK(other.material != match.material);
        CHECK(other.light == match.light);
        CHECK(sample.object == match.object);
        CHECK(other.object == match.object);
    }
}

TEST_CASE("a stream keeps its order, and asks for a block that does", "[unit]") {
    std::string text(study_and_test);
    text.erase(text.find("[[task]]"));
    text += "[[task]]\nid = \"n-back\"\nquestion = \"Again?\"\ntrials = { rule = \"stream\", of = "
            "\"object\", length = 40, back = 2 }\n";
    CHECK(ReadWithTable(text).lines() ==
          std::vector<std::string>{"p.toml:27:19: the trials of the rule \"stream\" come in its own order"});
    const Protocol protocol = sound(text + "[[block]]\nid = \"stream\"\norder = \"sequential\"\n");
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 9);
    REQUIRE(schedule.trials.size() == 40);
    int repeats = 0;
    for (std::size_t i = 2; i < 40; ++i) {
        const bool does_repeat = schedule.trials[i].stimulus == schedule.trials[i - 2].stimulus;
        CHECK(schedule.trials[i].correct == (does_repeat ? "repeat" : "new"));
        repeats += does_repeat;
    }
    CHECK(repeats == 10); // a quarter of 38
}
