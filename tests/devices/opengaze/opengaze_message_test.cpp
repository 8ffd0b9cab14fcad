#include "devices/opengaze/opengaze_message.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "devices/link/text_line.h"

using namespace overt;
using Kind = OpenGazeMessage::Kind;

namespace {

OpenGazeRecord record_of(std::string_view line) {
    const auto message = parse_opengaze(line);
    REQUIRE(message);
    REQUIRE(message->kind == Kind::record);
    return read_opengaze_record(*message);
}

} // namespace

// The examples are those of the document "Open Gaze API by Gazepoint", revision of March 11, 2025.

TEST_CASE("an Open Gaze record gives gaze, pupil and place of each eye as the interface documents them",
          "[unit]") {
    const OpenGazeRecord record = record_of(
        R"(<REC CNT="1484" TIME="4.99716" TIME_TICK="2096547271623" LPOGX="0.48439" LPOGY="0.50313" LPOGV="1" )"
        R"(RPOGX="-0.01" RPOGY="1.25" RPOGV="1" BPOGX="0.25" BPOGY="0.75" BPOGV="1" LPD="15.23866" LPS="1.04834" )"
        R"(LPV="1" LEYEX="-0.04796" LEYEY="0.00305" LEYEZ="0.69235" LPUPILD="0.00210" LPUPILV="1" )"
        R"(RPUPILD="0.0024" RPUPILV="0" REYEX="1" REYEY="1" REYEZ="1" RPMM="2.5" RPMMV="1" />)");
    CHECK(record.counter == 1484);
    CHECK(record.time_s == 4.99716);
    CHECK(record.ticks == 2096547271623);
    CHECK(record.left.gaze == glm::dvec2(0.48439, 0.50313));
    CHECK(record.right.gaze == glm::dvec2(-0.01, 1.25));
    CHECK(record.best == glm::dvec2(0.25, 0.75));
    CHECK(record.left.pupil_px == 15.23866);
    CHECK(*record.left.pupil_mm == Approx(2.1));
    REQUIRE(record.left.eye_mm);
    CHECK(record.left.eye_mm->x == Approx(-47.96f));
    CHECK(record.left.eye_mm->y == Approx(3.05f));
    CHECK(record.left.eye_mm->z == Approx(692.35f));
    CHECK_FALSE(record.right.eye_mm);
    CHECK(record.right.pupil_mm == 2.5);
}

TEST_CASE("what an Open Gaze record marks as not valid, or does not tell, is no measurement", "[unit]") {
    const OpenGazeRecord record = record_of(
        R"(<REC CNT="-" TIME="nan" TIME_TICK="1e3" LPOGX="0.5" LPOGY="0.5" LPOGV="0" RPOGX="0.5" RPOGV="1" BPOGX="" BPOGY="1" BPOGV="1" />)");
    CHECK_FALSE(record.counter);
    CHECK_FALSE(record.time_s);
    CHECK_FALSE(record.ticks);
    CHECK_FALSE(record.left.gaze);
    CHECK_FALSE(record.right.gaze);
    CHECK_FALSE(record.best);
}

TEST_CASE("attributes of Open Gaze are found whatever blanks stand between them", "[unit]") {
    for (const std::string_view line :
         {R"(<ACK ID="USER_DATA" VALUE="0" DUR="1" />)", R"(<ACK ID="USER_DATA" VALUE="0"DUR="1"/>)",
          R"(  <ACK	ID = "USER_DATA"   VALUE="0" DUR=" 1" / >)",
          R"(<ACK ID="USER_DATA"VALUE=" 0 "DUR="1" />>)",
          R"(<ACK noise ID="USER_DATA" "" VALUE=7 VALUE="0" DUR="1" DUR="9">)"}) {
        const auto message = parse_opengaze(line);
        CAPTURE(line);
        REQUIRE(message);
        CHECK(message->kind == Kind::acknowledged);
        CHECK(message->value("ID") == "USER_DATA");
        CHECK(message->value("VALUE") == "0");
        CHECK(message->number("DUR") == 1.0);
        CHECK_FALSE(message->value("STATE"));
    }
}

TEST_CASE("kinds of Open Gaze lines are told apart, and lines that are none are refused", "[unit]") {
    CHECK(parse_opengaze(R"(<NACK ID="X" />)")->kind == Kind::refused);
    CHECK(parse_opengaze(R"(<CAL ID=" CALIB_START_PT" PT="2" />)")->value("ID") == "CALIB_START_PT");
    CHECK(parse_opengaze(R"(<UPDATE ACTIVE_ID="1" MAX_ID="2" >)")->kind == Kind::other);
    CHECK(parse_opengaze("<RECORD />")->kind == Kind::other);
    CHECK(parse_opengaze("<REC/>")->kind == Kind::record);
    for (const std::string_view line : {"", " ", "REC />", R"(<REC LPOGX="0.123)", R"(OGV="1" />)", "<"})
        CHECK_FALSE(parse_opengaze(line));
}

TEST_CASE("a calibration's result gives each point and where each eye was measured", "[unit]") {
    const auto message = parse_opengaze(
        R"(<CAL ID="CALIB_RESULT" CALX1="0.50000" CALY1="0.50000" LX1="0.50229" LY1="0.50279" LV1="1" RX1="0.51467" RY1="0.50870" RV1="1" CALX2="0.85000" CALY2="0.15000" LX2="0.84943" LY2="0.14930" LV2="0" RX2="0.84600" RY2="0.14763" RV2="1" />>)");
    REQUIRE(message);
    const auto first = calibration_point(*message, 1), second = calibration_point(*message, 2);
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->target == glm::dvec2(0.5, 0.5));
    CHECK(first->left == glm::dvec2(0.50229, 0.50279));
    CHECK(first->right == glm::dvec2(0.51467, 0.5087));
    CHECK(second->target == glm::dvec2(0.85, 0.15));
    CHECK_FALSE(second->left);
    CHECK_FALSE(calibration_point(*message, 3));
}

TEST_CASE("no text can end a value or an element of Open Gaze", "[unit]") {
    CHECK(opengaze_text("TRIALID 3 \"runner\" <b>&\r\n") == "TRIALID 3  runner   b    ");
}

TEST_CASE("a stream of Open Gaze gives the same records however it is cut into pieces", "[unit]") {
    std::string stream;
    for (int i = 0; i < 50; ++i)
        stream += fmt::format("<REC CNT=\"{}\" LPOGX=\"0.{:03}\" LPOGY=\"0.5\" LPOGV=\"1\" />\r\n", i, i);
    const auto sum_of = [&](auto&& next_piece) {
        LineSplitter splitter(4096);
        double sum = 0.0;
        for (std::string_view rest = stream; !rest.empty();) {
            const std::string_view piece = rest.substr(0, next_piece());
            rest.remove_prefix(piece.size());
            splitter.feed(piece, [&](std::string_view line) {
                const OpenGazeRecord record = record_of(line);
                sum += static_cast<double>(*record.counter + 1) * record.left.gaze->x;
            });
        }
        return sum;
    };
    const double whole = sum_of([&] { return stream.size(); });
    CHECK(whole > 0.0);
    CHECK(sum_of([] { return 1u; }) == whole);
    CHECK(sum_of([] { return 7u; }) == whole);
}
