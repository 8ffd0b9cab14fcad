#include "devices/display_box/display_plus_plus_search.h"

#include <map>

#include <catch2/catch.hpp>

#include "devices/display_box/switch_record.h"
#include "experiment/base/error.h"
#include "tests/devices/link/in_memory_line.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// A machine with boxes and with devices that say nothing, by port.
struct MachineWithPorts {
    VirtualClock clock;
    std::map<std::string, std::unique_ptr<InMemoryBitsBox>> boxes;
    std::map<std::string, std::unique_ptr<FarEnd>> mute;
    std::vector<SerialPortInfo> ports;
    std::vector<std::string> opened;
    DisplayPlusPlusSettings settings;

    InMemoryBitsBox& add_box(const std::string& port, const std::string& serial_number,
                             std::optional<std::uint16_t> vendor = std::nullopt) {
        auto& box = boxes[port] = std::make_unique<InMemoryBitsBox>(clock);
        box->far.port = port;
        box->model.serial_number = serial_number;
        ports.push_back({port, vendor, std::uint16_t{1}, "", "", "", {}});
        return *box;
    }
    void add_mute(const std::string& port, std::uint16_t vendor, std::uint16_t product) {
        auto& device = mute[port] = std::make_unique<FarEnd>(clock);
        device->port = port;
        ports.push_back({port, vendor, product, "", "a modem", ""});
    }
    TransportOpener opener() {
        return [this](const std::string& port) -> std::unique_ptr<ByteTransport> {
            opened.push_back(port);
            if (const auto box = boxes.find(port); box != boxes.end())
                return box->second->line();
            if (const auto device = mute.find(port); device != mute.end())
                return std::make_unique<InMemoryLine>(*device->second);
            throw DeviceError(port + " cannot be opened");
        };
    }
    std::unique_ptr<DisplayPlusPlus> find(const std::optional<std::string>& port = std::nullopt) {
        return find_display_plus_plus(ports, port, opener(), clock, settings);
    }
};

} // namespace

TEST_CASE("the box is found among devices that do not answer", "[unit]") {
    MachineWithPorts machine;
    machine.add_mute("/dev/ttyACM0", 0x2341, 0x0043);
    machine.add_box("/dev/ttyACM1", "7");
    CHECK(machine.find()->identity().port == "/dev/ttyACM1");
    CHECK(machine.opened.size() == 2);
}

TEST_CASE("devices of other makers are left in peace when one of the vendor's answers, its other instruments "
          "always",
          "[unit]") {
    MachineWithPorts machine;
    machine.add_mute("/dev/ttyACM0", 0x2341, 0x0043);
    machine.add_mute("/dev/ttyACM1", 0x0861, 0x1001);
    machine.add_box("/dev/ttyACM2", "7", crs_vendor_id);
    CHECK(machine.find()->identity().port == "/dev/ttyACM2");
    CHECK(machine.opened == std::vector<std::string>{"/dev/ttyACM2"});
}

TEST_CASE("no box, or two, is an error that names each port and what came of it", "[unit]") {
    MachineWithPorts machine;
    CHECK_THROWS_WITH(machine.find(), Contains("no USB serial port"));
    machine.add_mute("/dev/ttyACM0", 0x2341, 0x0043);
    machine.add_mute("/dev/ttyACM1", 0x0861, 0x1001);
    machine.ports.push_back({"/dev/ttyACM2", {}, {}, {}, {}, {}});
    CHECK_THROWS_WITH(machine.find(), Contains("ttyACM0: no line beginning with \"#ProductType;\"") &&
                                          Contains("ttyACM1 (0861:1001") &&
                                          Contains("ttyACM2 cannot be opened"));
    machine.add_box("/dev/ttyACM3", "7");
    machine.add_box("/dev/ttyACM4", "8");
    CHECK_THROWS_WITH(machine.find(),
                      Contains("ttyACM3") && Contains("serial number 8") && Contains("name the port"));
    CHECK(machine.find("/dev/ttyACM4")->identity().serial_number == "8");
}

TEST_CASE("a box left switched by a crash is switched back at the next start, on whatever port it is then",
          "[unit]") {
    const TemporaryFolder folder;
    MachineWithPorts machine;
    machine.settings.record_folder = folder.path() / "state";
    InMemoryBitsBox& box = machine.add_box("/dev/ttyACM0", "7");
    CHECK_FALSE(recover_display(machine.ports, machine.opener(), machine.clock, machine.settings));

    auto display = machine.find();
    display->set_mode(BoxMode::color_plus_plus);
    box.far.unplugged = true; // nothing that is said from here on is heard: as good as a crash
    display.reset();
    CHECK(box.model.mode == "colorPlusPlus");
    CHECK(read_switch_record(machine.settings.record_folder) == SwitchRecord{"/dev/ttyACM0", "7", "Color++"});
    CHECK_THROWS_WITH(recover_display(machine.ports, machine.opener(), machine.clock, machine.settings),
                      Contains("Color++"));
    CHECK(read_switch_record(machine.settings.record_folder));

    {
        // Where another box lies on its port, that is told of, and left as it is.
        MachineWithPorts others;
        others.settings = machine.settings;
        others.add_box("/dev/ttyACM0", "99");
        CHECK_THROWS_WITH(
            recover_display(others.ports, others.opener(), others.clock, others.settings),
            "the display box 7 was left in Color++ mode by a run that did not end well, or is still at it; "
            "it "
            "could not be switched back: plug it in, or wait until that run has ended. Asked were:\n  "
            "/dev/ttyACM0: another box, serial number 99");
    }
    box.far.unplugged = false;
    box.model.rate_hz = 0.0; // the screen sleeps, which is no reason to leave it in Color++
    SECTION("on the same port") {}
    SECTION("on another port, with another box on the old one") {
        auto node = machine.boxes.extract("/dev/ttyACM0");
        node.key() = "/dev/ttyACM5";
        node.mapped()->far.port = "/dev/ttyACM5";
        machine.boxes.insert(std::move(node));
        machine.ports.front().path = "/dev/ttyACM5";
        machine.add_box("/dev/ttyACM0", "99");
    }
    const auto done = recover_display(machine.ports, machine.opener(), machine.clock, machine.settings);
    REQUIRE(done);
    CHECK_THAT(*done, Contains(box.far.port) && Contains("back in Bits++"));
    CHECK(box.model.mode == "BitsPlusPlus");
    CHECK_FALSE(read_switch_record(machine.settings.record_folder));
}

TEST_CASE("the note that the box is switched is there before the command and gone after the way back",
          "[unit]") {
    const TemporaryFolder folder;
    MachineWithPorts machine;
    machine.settings.record_folder = folder.path();
    InMemoryBitsBox& box = machine.add_box("/dev/ttyACM0", "7");
    const auto answer = box.far.answer;
    bool noted_first = false;
    box.far.answer = [&](std::string_view bytes) {
        if (bytes.starts_with("$mono"))
            noted_first = read_switch_record(folder.path()).has_value();
        return answer(bytes);
    };
    auto display = machine.find();
    display->set_mode(BoxMode::mono_plus_plus);
    CHECK(noted_first);
    display->leave();
    CHECK_FALSE(read_switch_record(folder.path()));
}

TEST_CASE("a note that cannot be written or read is an error that names the file", "[unit]") {
    const TemporaryFolder folder;
    folder.file("occupied", "");
    CHECK_THROWS_WITH(write_switch_record(folder.path() / "occupied", {"/dev/ttyACM0", "7", "Mono++"}),
                      Contains("occupied/display-switched.txt"));
    folder.file("display-switched.txt", "gibberish\n\n=\n");
    CHECK_THROWS_AS(read_switch_record(folder.path()), RecordError);
}

TEST_CASE("a mode that is kept on purpose outlives its program, and only its user undoes it", "[unit]") {
    const TemporaryFolder folder;
    MachineWithPorts machine;
    machine.settings.record_folder = folder.path();
    InMemoryBitsBox& box = machine.add_box("/dev/ttyACM0", "7");
    {
        auto display = machine.find();
        display->set_mode(BoxMode::mono_plus_plus);
        display->keep_mode();
    }
    CHECK(box.model.mode == "monoPlusPlus");
    CHECK(read_switch_record(folder.path()) == SwitchRecord{"/dev/ttyACM0", "7", "Mono++", true});
    CHECK_FALSE(recover_display(machine.ports, machine.opener(), machine.clock, machine.settings));
    CHECK(box.model.mode == "monoPlusPlus");
    machine.find()->restore_desktop();
    CHECK(box.model.mode == "BitsPlusPlus");
    CHECK_FALSE(read_switch_record(folder.path()));
}

TEST_CASE("the way back waits for a box that is deaf while it changes its mode", "[unit]") {
    const TemporaryFolder folder;
    MachineWithPorts machine;
    machine.settings.record_folder = folder.path();
    InMemoryBitsBox& box = machine.add_box("/dev/ttyACM0", "7");
    auto display = machine.find();
    box.model.mode_change_s = 3.0;
    display->set_mode(BoxMode::color_plus_plus);
    display->leave();
    CHECK(box.model.mode == "BitsPlusPlus");
    CHECK_FALSE(read_switch_record(folder.path()));
}

TEST_CASE("asking at all ports says of each what came of it, and leaves a box as it was", "[unit]") {
    MachineWithPorts machine;
    machine.add_mute("/dev/ttyACM0", 0x2341, 0x0043);
    machine.add_mute("/dev/ttyACM1", 0x0861, 0x1001);
    const auto ask = [&machine](const std::optional<std::string>& port = std::nullopt) {
        return ask_for_display_boxes(machine.ports, port, machine.opener(), machine.clock, machine.settings);
    };
    auto asked = ask();
    REQUIRE(asked.size() == 2);
    CHECK_FALSE(asked[0].box);
    CHECK_THAT(asked[0].otherwise, Contains("ttyACM0: no line beginning"));
    CHECK_THAT(asked[1].otherwise, Contains("another kind of instrument"));

    InMemoryBitsBox& box = machine.add_box("/dev/ttyACM2", "7", crs_vendor_id);
    machine.opened.clear();
    asked = ask();
    REQUIRE(asked.size() == 3);
    REQUIRE(asked[0].box);
    CHECK(asked[0].box->serial_number == "7");
    CHECK(asked[0].video_rate_hz == 120.0);
    CHECK(asked[1].port.path == "/dev/ttyACM0");
    CHECK(asked[1].otherwise == "another maker's device, not asked: the box was found");
    CHECK(asked[2].port.path == "/dev/ttyACM1");
    CHECK(asked[2].otherwise == "another kind of instrument, not asked");
    CHECK(machine.opened == std::vector<std::string>{"/dev/ttyACM2"});
    for (const std::string& command : box.model.commands)
        CHECK(command.find("PlusPlus") == std::string::npos);
    CHECK_THAT(ask("/dev/ttyACM9").front().otherwise, Contains("cannot be opened"));
}
