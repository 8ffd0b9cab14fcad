#include "devices/light/colorcal.h"

#include <map>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "tests/devices/link/in_memory_line.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// A ColorCAL in memory: commands end with LF, answers with LF CR and a prompt.
struct Photometer {
    VirtualClock clock;
    FarEnd far{clock};
    std::map<std::string, std::string> answers{
        {"IDR", "OK00,ColorCAL MkII,2.10,ser,C0815,bld, 905"},
        {"r01", "OK00,13500,50200,1"},
        {"r02", "OK00, 400,10000,50003"},
        {"r03", "OK00,0,99999,49999"},
        {"MES", "OK00,10.5,20,-0.25"},
        {"UZC", "OK00"},
    };
    std::map<std::string, SessionDuration> takes;
    std::vector<std::string> commands;

    Photometer() {
        far.answer = [this](std::string_view bytes) -> std::string {
            REQUIRE(bytes.ends_with("\n"));
            commands.emplace_back(bytes.substr(0, bytes.size() - 1));
            far.delay = takes.contains(commands.back()) ? takes[commands.back()] : 2ms;
            const std::string& answer = answers[commands.back()];
            return answer.empty() ? answer : answer + "\n\r>";
        };
    }
    ColorCal open() { return ColorCal(std::make_unique<InMemoryLine>(far), clock); }
};

} // namespace

TEST_CASE("a photometer says who it is, and its matrix turns what it measures into XYZ", "[unit]") {
    Photometer photometer;
    photometer.takes["MES"] = 4800ms;
    ColorCal colorcal = photometer.open();
    CHECK(colorcal.identity().firmware == "2.10");
    CHECK(colorcal.identity().serial_number == "C0815");
    CHECK(colorcal.identity().build == 905);
    CHECK_FALSE(colorcal.forgets_dark_level());
    const glm::dvec3 xyz = colorcal.measure_xyz();
    CHECK(xyz.x == Approx(1.35 * 10.5 - 0.02 * 20.0 - 0.0001 * 0.25));
    CHECK(xyz.y == Approx(0.04 * 10.5 + 1.0 * 20.0 + 0.0003 * 0.25));
    CHECK(xyz.z == Approx(-4.9999 * 20.0 - 4.9999 * 0.25));
}

TEST_CASE("a number of the matrix below 50000 is positive, the others negative", "[unit]") {
    CHECK(colorcal_matrix_entry("0") == 0.0);
    CHECK(colorcal_matrix_entry("49999") == 4.9999);
    CHECK(colorcal_matrix_entry("50000") == 0.0);
    CHECK(colorcal_matrix_entry("50001") == -0.0001);
    CHECK(colorcal_matrix_entry("99999") == -4.9999);
    for (const char* text : {"", "-1", "100000", "1.5", "12a", "99999999999999"})
        CHECK_FALSE(colorcal_matrix_entry(text));
}

TEST_CASE("however a photometer's answers are split, it is understood", "[unit]") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        RandomStream random(seed, "colorcal split test");
        Photometer photometer;
        photometer.far.piece = [&random] { return static_cast<std::size_t>(random.uniform(1.0, 9.0)); };
        ColorCal colorcal = photometer.open();
        CHECK(colorcal.identity().serial_number == "C0815");
        CHECK(colorcal.measure_xyz().y == Approx(0.42 + 20.0 + 0.000075));
    }
}

TEST_CASE("a photometer's errors come with their code, and light on a covered lens with what to do",
          "[unit]") {
    Photometer photometer;
    ColorCal colorcal = photometer.open();
    CHECK_NOTHROW(colorcal.calibrate_dark());
    photometer.answers["UZC"] = "ER11";
    CHECK_THROWS_WITH(colorcal.calibrate_dark(), Contains("ER11") && Contains("cover its lens"));
    photometer.answers["MES"] = "ER02,overload";
    CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("MES") && Contains("ER02,overload"));
    photometer.answers["MES"] = "OK00,1,2";
    CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("three numbers"));
    photometer.answers["MES"] = "OK00,1,2,nan";
    CHECK_THROWS_AS(colorcal.measure_xyz(), DeviceError);
    photometer.answers["MES"] = "";
    const SessionTime begun = photometer.clock.now();
    CHECK_THROWS_WITH(colorcal.measure_xyz(),
                      Contains("/dev/ttyACM0") && Contains("5.0 s") && Contains("nothing"));
    CHECK(to_seconds(photometer.clock.now() - begun) == Approx(5.0).margin(0.01));
    photometer.far.unplugged = true;
    CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("unplugged by the test"));
}

TEST_CASE("what is no photometer is refused when it is opened", "[unit]") {
    for (const char* identity : {"", "ERROR", "OK00", "OK00,a,b,c,d,build", "#IDR;x;", "OK0"}) {
        Photometer photometer;
        photometer.answers["IDR"] = identity;
        INFO(identity);
        CHECK_THROWS_AS(photometer.open(), DeviceError);
    }
    Photometer photometer;
    photometer.answers["r02"] = "OK00,1,2,x";
    CHECK_THROWS_WITH(photometer.open(), Contains("r02"));
    photometer.answers["IDR"] = "OK00,ColorCAL MkII,2.10,ser,C0815,bld,876";
    photometer.answers["r02"] = "OK00,1,2,3";
    CHECK(photometer.open().forgets_dark_level());
}

TEST_CASE("no damage to a photometer's answers makes the program hang or fall", "[unit]") {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        RandomStream random(seed, "colorcal damage test");
        Photometer photometer;
        const auto answer = photometer.far.answer;
        photometer.far.answer = [&](std::string_view bytes) {
            std::string text = answer(bytes);
            while (!text.empty() && random.uniform() < 0.3) {
                const auto at =
                    static_cast<std::size_t>(random.uniform() * 0.999 * static_cast<double>(text.size()));
                if (random.uniform() < 0.5)
                    text[at] = static_cast<char>(random.uniform(-128.0, 127.0));
                else
                    text.erase(at, 3);
            }
            return text;
        };
        try {
            const glm::dvec3 xyz = photometer.open().measure_xyz();
            CHECK((std::isfinite(xyz.x) && std::isfinite(xyz.y) && std::isfinite(xyz.z)));
        } catch (const DeviceError&) {
        }
        CHECK(to_seconds(photometer.clock.now()) < 8.0);
    }
}

TEST_CASE("the photometer is found by its USB numbers or by its port", "[unit]") {
    Photometer photometer;
    std::vector<std::string> opened;
    const TransportOpener open = [&](const std::string& port) {
        opened.push_back(port);
        return std::make_unique<InMemoryLine>(photometer.far);
    };
    std::vector<SerialPortInfo> ports{{"/dev/ttyACM0", crs_vendor_id, std::uint16_t{2}, "", "", ""},
                                      {"/dev/ttyACM1", crs_vendor_id, std::uint16_t{0x1001}, "", "", ""}};
    find_colorcal(ports, std::nullopt, open, photometer.clock);
    find_colorcal(ports, "/dev/ttyACM7", open, photometer.clock);
    CHECK(opened == std::vector<std::string>{"/dev/ttyACM1", "/dev/ttyACM7"});
    ports.push_back(ports.back());
    CHECK_THROWS_WITH(find_colorcal(ports, std::nullopt, open, photometer.clock), Contains("2 ColorCALs"));
    ports.resize(1);
    CHECK_THROWS_WITH(find_colorcal(ports, std::nullopt, open, photometer.clock), Contains("no ColorCAL"));
}

TEST_CASE("an answer of a photometer is two letters and two digits, and its name has six fields at least",
          "[unit]") {
    const auto opens_with = [](const std::string& answer) {
        Photometer photometer;
        photometer.answers["IDR"] = answer;
        try {
            return photometer.open().identity().build;
        } catch (const DeviceError&) {
            return -1;
        }
    };
    CHECK(opens_with("OK00,a,b,c,d, 7") == 7); // six
    CHECK(opens_with("OK00,a,b,c, 7") == -1);
    CHECK(opens_with("OK00,a,b,c,d,e, 8") == 8);
    CHECK(opens_with("OK00,a,b,c,d,e") == -1);
    CHECK(opens_with("OK0x\nOKx0\nOK\nXX00\nok00\n> OK00,a,b,c,d, 9") == 9); // what is none stands before it
    for (const auto& [entry, value] :
         {std::pair{"0", 0.0}, {"49999", 4.9999}, {"50000", 0.0}, {"50001", -0.0001}, {"99999", -4.9999}})
        CHECK(colorcal_matrix_entry(entry) == value);
    CHECK_FALSE(colorcal_matrix_entry("100000"));
    CHECK_FALSE(colorcal_matrix_entry("-1"));
    CHECK_FALSE(colorcal_matrix_entry("1.5"));
    for (const char* const numbers : {"OK00,1,2", "OK00,1,2,3,4", "OK00,1,2,x"}) {
        Photometer photometer;
        ColorCal colorcal = photometer.open();
        photometer.answers["MES"] = numbers;
        CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("was not answered with three numbers"));
    }
}

TEST_CASE("what is left of earlier answers, however much, is no answer to the next command", "[unit]") {
    Photometer photometer;
    ColorCal colorcal = photometer.open();
    for (const std::size_t bytes : {10u, 256u, 257u, 600u, 1024u}) {
        CAPTURE(bytes);
        std::string old;
        while (old.size() < bytes)
            old += "OK00,1,2,3\n\r>";
        photometer.far.send(photometer.clock.now(), old);
        CHECK(colorcal.measure_xyz().y == Approx(0.42 + 20.0 + 0.000075));
    }
    // What never ends is not read for ever.
    int pieces = 0;
    photometer.far.before_read = [&](SessionTime) {
        if (++pieces < 3000)
            photometer.far.send(photometer.clock.now(), std::string(256, 'x'));
    };
    CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("no answer to \"MES\" came"));
    CHECK(pieces >= 1000);
    CHECK(pieces < 1010);
    CHECK(photometer.commands.back() == "MES");
}

TEST_CASE("a row of the matrix that cannot be read is named with the port and the command", "[unit]") {
    for (const char* const row : {"r01", "r02", "r03"}) {
        Photometer photometer;
        photometer.answers[row] = "OK00,1,2,x";
        CHECK_THROWS_WITH(photometer.open(), Catch::StartsWith(std::string("/dev/ttyACM0: \"") + row +
                                                               "\" was not answered with three integers"));
    }
}

TEST_CASE("what is wrong with a photometer is said with its port, the command and what came", "[unit]") {
    Photometer photometer;
    ColorCal colorcal = photometer.open();
    photometer.answers["MES"] = "ER02,overload";
    CHECK_THROWS_WITH(
        colorcal.measure_xyz(),
        "/dev/ttyACM0: \"MES\" was answered with ER02,overload: plug the photometer out and in and "
        "try again.");
    photometer.answers["UZC"] = "ER11";
    CHECK_THROWS_WITH(colorcal.calibrate_dark(), "/dev/ttyACM0: \"UZC\" was answered with ER11: the "
                                                 "photometer sees light: cover its lens and try again.");
    photometer.answers["MES"] = "";
    CHECK_THROWS_WITH(
        colorcal.measure_xyz(),
        "/dev/ttyACM0: no answer to \"MES\" came within 5.0 s, but nothing; see that this is the "
        "photometer's port.");
    photometer.answers["MES"] = "OK0";
    CHECK_THROWS_WITH(colorcal.measure_xyz(), Contains("came within 5.0 s, but \"OK0\\x0a\\x0d>\"; see"));
    photometer.answers["MES"] = "OK00,1,2";
    CHECK_THROWS_WITH(colorcal.measure_xyz(),
                      "/dev/ttyACM0: \"MES\" was not answered with three numbers; measure again.");
    // Taken, but not answered any more.
    photometer.far.before_read = [&](SessionTime) { photometer.far.unplugged = true; };
    CHECK_THROWS_WITH(colorcal.measure_xyz(),
                      Contains("/dev/ttyACM0: ") && Contains("\"MES\"") && Contains("unplugged by the test"));
    photometer.far.before_read = nullptr;
    photometer.far.unplugged = false;
    photometer.far.takes_bytes = false;
    CHECK_THROWS_WITH(colorcal.measure_xyz(),
                      "/dev/ttyACM0: the photometer did not take \"MES\" (it is busy); plug it out and in.");
    photometer.far.unplugged = true;
    CHECK_THROWS_WITH(colorcal.measure_xyz(),
                      Contains("the photometer did not take \"MES\" (") && Contains("unplugged by the test"));
    const std::vector<SerialPortInfo> ports{
        {"/dev/ttyACM0", crs_vendor_id, std::uint16_t{2}, "", "", ""},
        {"/dev/ttyACM1", crs_vendor_id, std::uint16_t{0x1001}, "", "", ""},
        {"/dev/ttyACM2", crs_vendor_id, std::uint16_t{0x1001}, "", "", ""}};
    const TransportOpener open = [&](const std::string&) {
        return std::make_unique<InMemoryLine>(photometer.far);
    };
    CHECK_THROWS_WITH(
        find_colorcal(ports, std::nullopt, open, photometer.clock),
        "2 ColorCALs are plugged in, among them /dev/ttyACM1 and /dev/ttyACM2; name the port of the "
        "one to use.");
    CHECK_THROWS_WITH(
        find_colorcal(std::span(ports).first(1), std::nullopt, open, photometer.clock),
        "no ColorCAL is among the 1 USB serial ports (its numbers are 0861:1001); plug it in or name "
        "its port.");
}
