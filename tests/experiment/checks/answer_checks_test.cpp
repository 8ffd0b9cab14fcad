/// Answers that cannot be given, or are never asked for, are errors at their places; what is asked is said in
/// words.
#include <catch2/catch.hpp>

#include "experiment/design/answer_words.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

using FoundLines = std::vector<std::string>;

/// A task of a minimal protocol with these steps in line 15, and these answers from line 16 on.
ReadText with_answers(const std::string& steps, const std::string& answers) {
    return ReadText(minimal_protocol,
                    "[[task]]\nid = \"t\"\nquestion = \"Which?\"\nsteps = [" + steps + "]\n" + answers);
}

/// The findings about an answer of this many keys, asked for in a step.
FoundLines findings_of(const std::string& answer) {
    return with_answers("{ show = \"centre\" }, { answer = \"a\" }", "[[task.answer]]\nid = \"a\"\n" + answer)
        .lines();
}

} // namespace

TEST_CASE("answers are read with their keys, several of a task", "[unit]") {
    const ReadText read =
        with_answers("{ show = \"centre\", until = \"answer\", limit_s = 2 }, { answer = \"a\" }, "
                     "{ answer = [\"b\"] }",
                     R"([[task.answer]]
id = "a"
kind = "choice"
choices = ["old", "new"]
keys = ["o", "n"]
opens = 0.2
limit_s = 3
zero = "window"
simulated = { share_correct = 0.8 }
[[task.answer]]
id = "b"
kind = "scale"
steps = 7
ends = ["low", "high"]
opens = "screen"
[[task]]
id = "other"
question = "Look."
)");
    CHECK(read.lines() == FoundLines{});
    REQUIRE(read.protocol);
    REQUIRE(read.protocol->tasks.size() == 3);
    const Task& task = read.protocol->tasks[1];
    CHECK(read.protocol->tasks[2].answers.empty());
    REQUIRE(task.answers.size() == 2);
    CHECK(task.answers[0].choices == std::vector<std::string>{"old", "new"});
    CHECK(task.answers[0].opens.after_s == 0.2);
    CHECK(task.answers[0].zero == AnswerZero::window);
    CHECK(task.answers[0].truth.share_correct == 0.8);
    CHECK(task.answers[1].opens.from == AnswerOpening::From::screen);
    CHECK(task.steps[0].ends_by_answer);
    CHECK(task.steps[2].answers == std::vector<std::string>{"b"});
    const std::string words = describe_answers(*read.protocol, task);
    CHECK_THAT(words, Contains("old by the key o, new by the key n"));
    CHECK_THAT(words, Contains("presses count from 0.2 s after the stimulus's onset for 3 s"));
    CHECK_THAT(words, Contains("7 steps, 1 to 7, by the keys 1 to 7"));
    CHECK_THAT(words, Contains("enter accepts it"));
}

TEST_CASE("an answer that cannot be given is an error at its key", "[unit]") {
    CHECK(findings_of("kind = \"choice\"\nchoices = [\"x\", \"y\"]\n") ==
          FoundLines{"19:11: the choices have no keys, and cannot be given"});
    CHECK(findings_of("kind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"f\"]\n") ==
          FoundLines{"20:8: the key \"f\" answers two things"});
    CHECK(findings_of("kind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"f3\"]\n") ==
          FoundLines{"20:8: the key \"f3\" is the operator's: \"repeat\" of [operator]"});
    CHECK(findings_of("kind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"jj\"]\n") ==
          FoundLines{"20:8: there is no key \"jj\""});
    CHECK(findings_of(
              "kind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"j\"]\ncorrect = \"z\"\n") ==
          FoundLines{"21:11: no choice is \"z\""});
    CHECK(findings_of("kind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"j\"]\nsteps = 7\n") ==
          FoundLines{"21:9: an answer of kind \"choice\" has no \"steps\""});
    CHECK(findings_of("kind = \"scale\"\nmin = 3\nmax = 1\n") ==
          FoundLines{"20:7: the scale goes from 3 to 1"});
    CHECK(findings_of("kind = \"text\"\n") == FoundLines{});
}

TEST_CASE("an answer that no step asks for, and a step without answers, are errors", "[unit]") {
    CHECK(with_answers("{ show = \"centre\" }", "[[task.answer]]\nid = \"a\"\nkind = \"text\"\n").lines() ==
          FoundLines{"17:6: no step asks for the answer \"a\""});
    CHECK(with_answers("{ show = \"centre\" }, { answer = \"b\" }", "").lines() ==
          FoundLines{"15:42: task t has no answer \"b\""});
    CHECK(with_answers("{ show = \"centre\", until = \"answer\" }", "").lines() ==
          FoundLines{"15:37: task t has no answer that could end this step"});
    CHECK(with_answers("{ show = \"centre\", until = \"answer\" }, { answer = \"a\" }",
                       "[[task.answer]]\nid = \"a\"\nkind = \"text\"\n")
              .lines() ==
          FoundLines{"15:37: \"a\" is a text, and cannot be given while it is not on the screen"});
}

TEST_CASE("the odd one out is one of three slots at least, and times grow with a factor of numbers",
          "[unit]") {
    const std::string odd = "kind = \"odd-one-out\"\n";
    CHECK_THAT(findings_of(odd + "choices = [\"a\", \"b\", \"c\"]\nkeys = [\"1\", \"2\", \"3\"]\n").at(0),
               Contains("one is odd among three slots or more"));
    const std::string choice = "kind = \"choice\"\nchoices = [\"a\", \"b\"]\nkeys = [\"f\", \"j\"]\n";
    CHECK_THAT(findings_of(choice + "simulated = { time_gain_s = 0.1 }\n").at(0),
               Contains("nothing says with which factor times grow"));
    CHECK_THAT(findings_of(choice + "simulated = { time_by = \"set_sise\" }\n").at(0),
               Contains("there is no factor \"set_sise\""));
    CHECK_THAT(findings_of(choice + "simulated = { time_by = \"material\" }\n").at(0),
               Contains("are no numbers"));
}
