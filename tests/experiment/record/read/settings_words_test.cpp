#include <catch2/catch.hpp>

#include "experiment/events/event_settings.h"
#include "experiment/record/read/settings_words.h"

using namespace overt;
using Catch::Contains;

TEST_CASE("settings of a detector are told in words with their units, whatever they are called", "[unit]") {
    CHECK(settings_in_words(R"({"velocity_deg_s":30,"acceleration_deg_s2":8000.0,"noise_window_ms":2.5})") ==
          "velocity 30 deg/s, acceleration 8000 deg/s2, noise window 2.5 ms");
    CHECK(settings_in_words(R"({"method":"I-VT","is_adaptive":true,"factor":0.5,"lambda_s":"auto"})") ==
          "method I-VT, is adaptive yes, factor 0.5, lambda s auto");
    CHECK(settings_in_words("{}").empty());
    CHECK(settings_in_words("by hand") == "by hand");
    const std::string own = settings_in_words(json_of(EventSettings{}));
    CHECK_THAT(own, Contains("velocity 30 deg/s") && !Contains("{") && !Contains("\"") && !Contains("_"));
}
