#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// What is found in the minimal protocol with these lines, which begin at line 12, each with its place.
std::vector<std::string> found(const std::string& more) { return ReadText(minimal_protocol, more).lines(); }

std::string box(const std::string& more) { return "[[button_box]]\nid = \"pad\"\n" + more; }
std::string output(const std::string& more) { return "[[marker_output]]\nid = \"eeg\"\n" + more; }

void check_fault(const std::string& more, const std::string& place, const std::string& words) {
    const std::vector<std::string> lines = found(more);
    CAPTURE(more, lines);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].starts_with(place + ": "));
    CHECK_THAT(lines[0], Contains(words));
}

} // namespace

TEST_CASE("response boxes that cannot be meant so are errors at their keys", "[unit]") {
    check_fault(box("kind = \"iolab\"\nbuttons = [\"1 nxt\"]\n"), "15:11", "says no meaning of a button");
    check_fault(box("kind = \"iolab\"\nbuttons = [\"1 next\", \"1 back\"]\n"), "15:11", "has two meanings");
    check_fault(box("kind = \"iolab\"\nbuttons = [\"1 abort\"]\n"), "15:11", "says no meaning");
    check_fault(box("kind = \"iolab\"\nused_by = \"operator\"\n"), "15:11", "needs \"buttons\"");
    check_fault(box("kind = \"iolab\"\nused_by = \"operator\"\nbuttons = [\"1 next\"]\n"), "16:11",
                "recalibrate");
    check_fault(box("kind = \"hid\"\n"), "14:8", "needs its \"address\"");
    check_fault(box("kind = \"cb6\"\naddress = \"/dev/ttyACM0\"\n"), "15:11", "has no address");
    check_fault(box("kind = \"cb6\"\n[display]\noutput = \"native-8bit\"\ngamma = 2.2\n"), "14:8",
                "this session has none");
    check_fault(box("kind = \"iolab\"\n[[button_box]]\nid = \"pad\"\nkind = \"iolab\"\n"), "16:6",
                "is taken already");
    check_fault(box("kind = \"joystick\"\n"), "14:8", "unknown value");
    check_fault(box("kind = \"dial\"\n"), "14:8", "needs its \"address\"");
    check_fault(box("kind = \"spacemouse\"\nsteps_per_count = 2\n"), "15:19",
                "\"steps_per_count\" says nothing of a box of kind spacemouse");
    check_fault(box("kind = \"iolab\"\ndead_zone = 0.2\n"), "15:13", "says nothing of a box of kind iolab");
    check_fault(box("kind = \"spacemouse\"\nused_by = \"operator\"\nbuttons = [\"1 pause\"]\n"), "15:11",
                "a knob is the observer's");
    CHECK(found(box("kind = \"spacemouse\"\nfull_turn_steps_s = -40\ndead_zone = 0.2\n")).empty());
    CHECK(found(box("kind = \"dial\"\naddress = \"045e:091b\"\nsteps_per_count = 0.1\n")).empty());
}

TEST_CASE("further eye trackers that cannot be meant so are errors at their keys", "[unit]") {
    const std::string further = "[[further_tracker]]\nid = \"second\"\n";
    CHECK(found(further).empty());
    CHECK(found(further + "kind = \"eyelink\"\nrate_hz = 500\n").empty());
    check_fault(further + "kind = \"none\"\n", "14:8", "must measure gaze");
    check_fault(further + "[tracker]\nkind = \"none\"\n", "15:8",
                "there is no eye tracker of the session's own");
    check_fault(further + "kind = \"lsl\"\n[tracker]\nkind = \"lsl\"\n", "14:8",
                "the same device as that of [tracker]");
    check_fault(further +
                    "kind = \"lsl\"\naddress = \"a\"\n[[further_tracker]]\nid = \"third\"\nkind = \"lsl\"\n"
                    "address = \"a\"\n",
                "18:8", "that of the further tracker \"second\"");
    CHECK(found(further + "kind = \"lsl\"\naddress = \"a\"\n[tracker]\nkind = \"lsl\"\n").empty());
    check_fault(further + further, "15:6", "is taken already");
    check_fault(further + "drift_limit_deg = 1\n", "14:1", "drift_limit_deg");
}

TEST_CASE("a keyboard that is the operator's alone needs a box that answers", "[unit]") {
    const std::string alone = "[operator]\nkeyboard_answers = false\n";
    check_fault(alone, "13:20", "nothing would answer for the observer");
    check_fault(alone + box("kind = \"iolab\"\nused_by = \"operator\"\nbuttons = [\"1 yes\"]\n"), "13:20",
                "nothing would answer for the observer");
    CHECK(found(alone + box("kind = \"iolab\"\n")).empty());
    check_fault(alone + box("kind = \"iolab\"\n") + "[consent]\ntext = \"Agreed?\"\n", "13:20",
                "could not agree or decline");
    CHECK(found(alone + box("kind = \"iolab\"\nbuttons = [\"1 next\", \"2 yes\", \"3 no\"]\n") +
                "[consent]\ntext = \"Agreed?\"\n")
              .empty());
}

TEST_CASE("outputs of markers that cannot be meant so are errors at their keys", "[unit]") {
    const std::string port = "address = \"/dev/ttyUSB0\"\n";
    CHECK(found(output(port + "codes = [\"trial 1\", \"onset 10\", \"frame 2\", \"end 3\", \"response 4\", "
                              "\"result 5\"]\ncondition_codes = [\"task free 5\"]\n"))
              .empty());
    check_fault(output(port + "codes = [\"onset\"]\n"), "15:9", "is not an event and its code");
    check_fault(output(port + "codes = [\"begin 1\"]\n"), "15:9", "events are trial, onset, frame");
    check_fault(output(port + "codes = [\"onset 256\"]\n"), "15:9", "from 1 to 255");
    check_fault(output(port + "codes = [\"onset 0\"]\n"), "15:9", "from 1 to 255");
    check_fault(output(port + "codes = [\"onset 1x\"]\n"), "15:9", "from 1 to 255");
    check_fault(output(port + "codes = [\"onset 1\", \"onset 2\"]\n"), "15:9", "has a code already");
    check_fault(output(port + "codes = [\"onset 250\"]\ncondition_codes = [\"material clay 10\"]\n" +
                       "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n"),
                "16:19", "would have the code 260: 255 is the largest");
    check_fault(output(port + "codes = [\"onset 1\"]\ncondition_codes = [\"material wood 10\"]\n"), "16:19",
                "there is no material \"wood\"");
    check_fault(output(port + "codes = [\"onset 1\"]\ncondition_codes = [\"colour red 10\"]\n"), "16:19",
                "there is no factor \"colour\"; there are task, object, material");
    check_fault(output(port + "codes = [\"onset 1\"]\nrefresh_codes = [\"12 1\"]\n"), "16:17",
                "only outputs of kind t-lock");
    check_fault(output("codes = [\"onset 1\"]\n"), "12:1", "needs its \"address\"");
    check_fault(output(port), "12:1", "\"codes\" are missing");
    check_fault(output("kind = \"lsl\"\nbaud = 9600\n"), "15:8", "only serial outputs have a speed");
    check_fault(output("kind = \"lsl\"\naddress = \"x\"\n"), "15:11",
                "only serial, parallel and xid outputs have an address");
    CHECK(found(output("kind = \"lsl\"\n")).empty());
    CHECK(found(output("kind = \"xid\"\ncodes = [\"onset 255\"]\n")).empty());
    CHECK(found(output(port + "as_text = true\n")).empty()); // of all events
    check_fault(output("kind = \"lsl\"\nas_text = true\n"), "15:11",
                "only serial outputs take lines of text");
}

TEST_CASE("samples that are made up are not sent on, and the protocol is told so", "[unit]") {
    check_fault("[tracker]\noutlet = true\n", "13:10", "\"simulated\" are made up, and are not sent on");
    check_fault("[tracker]\nkind = \"none\"\noutlet = true\n", "14:10", "there is no eye tracker");
    CHECK(found("[tracker]\nkind = \"mouse\"\noutlet = true\n").empty());
}

TEST_CASE("what rides on the picture keeps to what the picture carries", "[unit]") {
    const std::string t_lock = "kind = \"t-lock\"\n";
    CHECK(found(output(t_lock + "codes = [\"onset 1023\", \"frame 1\"]\nrefresh_codes = [\"12 4\"]\n"))
              .empty());
    check_fault(output(t_lock + "codes = [\"onset 1024\"]\n"), "15:9", "from 1 to 1023");
    check_fault(output(t_lock + "codes = [\"response 4\"]\n"), "15:9", "marks onset and frame alone");
    check_fault(output(t_lock + "refresh_codes = [\"100000 4\"]\n"), "15:17", "a refresh of the animation");
    check_fault(output(t_lock + "refresh_codes = [\"7 4\", \"7 8\"]\n"), "15:17", "has a code already");
    check_fault(output(t_lock + "codes = [\"onset 1\"]\npulse_ms = 30\n"), "16:12", "24.8 ms");
    check_fault(output(t_lock + "codes = [\"onset 1\"]\n[display]\noutput = \"native-8bit\"\ngamma = 2.2\n"),
                "14:8", "native-8bit carries no digital outputs");
    check_fault(output(t_lock + "codes = [\"onset 1\"]\n[display]\nonset_trigger = 1\n"), "17:17",
                "those of a [[marker_output]] already");
}
