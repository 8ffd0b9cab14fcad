/// What the doctor says of eye trackers and of the network of an EyeLink.
#include "app/display/tracker_doctor.h"

#include <algorithm>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "app/rig/tracker_devices.h"

using namespace overt;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("the doctor says whether a network card is in the net of an EyeLink's host", "[unit]") {
    const NetworkCard office{"enp3s0", "192.168.1.7", true, true}, spare{"enp4s0", "", true, false};
    CHECK(eyelink_network(std::vector<NetworkCard>{}) == "there is no network card");
    CHECK(eyelink_network(std::vector{office, spare}) ==
          "no card is in the net of an EyeLink's host (100.1.1.1): enp3s0 192.168.1.7, enp4s0 without an "
          "address. For one: sudo ip address add 100.1.1.2/24 dev enp4s0");
    CHECK_THAT(eyelink_network(std::vector{office}), Contains("/24 dev CARD"));

    NetworkCard right{"enp4s0", "100.1.1.2", true, true};
    CHECK(eyelink_network(std::vector{office, right}) ==
          "enp4s0 has 100.1.1.2, in the net of an EyeLink's host (100.1.1.1)");
    right.has_link = false;
    CHECK_THAT(eyelink_network(std::vector{right}), Contains("but no cable is plugged in"));
    right.is_up = false;
    CHECK_THAT(eyelink_network(std::vector{right}), Contains("but it is switched off"));
    right.address = "100.1.1.1";
    CHECK_THAT(eyelink_network(std::vector{right}), Contains("the address of an EyeLink's host itself"));
    right.address = "100.1.11.2";
    CHECK_THAT(eyelink_network(std::vector{right}), StartsWith("no card is in the net"));
}

TEST_CASE("the doctor names each tracker that is a device, what it can do and what is found", "[unit]") {
    const std::vector<DoctorFinding> findings = examine_trackers();
    for (const TrackerKind kind : all_kinds<TrackerKind>) {
        const TrackerDevice& device = tracker_device(kind, false);
        const auto found =
            std::ranges::find(findings, fmt::format("eye tracker, {}", name_of(kind)), &DoctorFinding::what);
        CHECK((found != findings.end()) == row_of(kind).is_hardware());
        if (!row_of(kind).is_hardware())
            continue;
        REQUIRE(device.look_for);
        CHECK_FALSE(device.can_do.empty());
        CHECK_THAT(found->finding, Contains(std::string(device.can_do)));
    }
}
