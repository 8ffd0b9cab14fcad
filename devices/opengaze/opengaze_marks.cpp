#include "devices/opengaze/opengaze_marks.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "devices/opengaze/opengaze_message.h"

namespace overt {
namespace {

constexpr std::string_view between_marks = " | ";

bool is_frame(const std::string& text) { return text.starts_with("FRAME"); }
bool is_variable(const std::string& text) { return text.starts_with("!V"); }

} // namespace

std::string OpenGazeMarks::joined() const { return fmt::format("{}", fmt::join(waiting_, between_marks)); }

void OpenGazeMarks::leave_one_out() {
    // Frames can be told again from the record of the session, variables stand in it too; when a trial began,
    // was lit and answered is what somebody looks for.
    auto out = std::ranges::find_if(waiting_, is_frame);
    frames_left_out_ += out != waiting_.end() ? 1 : 0;
    others_left_out_ += out != waiting_.end() ? 0 : 1;
    if (out == waiting_.end())
        out = std::ranges::find_if(waiting_, is_variable);
    waiting_.erase(out == waiting_.end() ? waiting_.begin() : out);
}

std::string OpenGazeMarks::add(std::string_view text, SessionTime now) {
    // A camera makes records whether they are sent to us or not, and some servers do not tell what they bear.
    if (now - sent_at_ > interval_ + interval_ / 2)
        waiting_.clear();
    waiting_.push_back(opengaze_text(text).substr(0, longest));
    sent_at_ = now;
    for (sent_ = joined(); sent_.size() > longest; sent_ = joined())
        leave_one_out();
    return sent_;
}

void OpenGazeMarks::borne(std::string_view user) noexcept {
    if (!waiting_.empty() && user == sent_)
        waiting_.clear();
}

} // namespace overt
