#include "devices/buttons/threaded_button_box.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// What a box without a clock is late by at most, besides USB.
constexpr SessionDuration looking_interval = std::chrono::milliseconds(1);
/// How soon the end of a session is seen while a box is looked for.
constexpr SessionDuration patient_interval = std::chrono::milliseconds(50);

} // namespace

ThreadedButtonBox::ThreadedButtonBox(Opener open, Clock& clock, ReadOn read_on,
                                     SessionDuration look_again_after)
    : open_(std::move(open)), clock_(clock), look_again_after_(look_again_after), box_(open_()),
      description_(box_->description()) {
    if (read_on == ReadOn::own_thread)
        thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

ThreadedButtonBox::~ThreadedButtonBox() = default;

std::string ThreadedButtonBox::button_name(int button) const {
    const std::lock_guard lock(box_mutex_);
    return box_ ? box_->button_name(button) : fmt::format("{}", button);
}

std::vector<BoxNews> ThreadedButtonBox::take_news() {
    const std::lock_guard lock(news_mutex_);
    has_news_ = false;
    if (lost_at_)
        news_.push_back({*std::exchange(lost_at_, std::nullopt), true, description_.model});
    return std::exchange(news_, {});
}

void ThreadedButtonBox::tell(bool is_lost, std::string words) noexcept {
    const std::lock_guard lock(news_mutex_);
    news_.push_back({clock_.now(), is_lost, std::move(words)});
    has_news_ = true;
}

void ThreadedButtonBox::serve(const std::stop_token& stop) noexcept {
    while (!stop.stop_requested()) {
        if (is_lost_) {
            look_for_it(stop);
            continue;
        }
        read();
        if (is_lost_)
            tell(true, description_.model);
        else
            clock_.wait_until(clock_.now() + looking_interval);
    }
}

void ThreadedButtonBox::begin() noexcept {
    if (thread_.joinable())
        begins_ = true;
    else
        begin_now();
}

void ThreadedButtonBox::begin_now() noexcept {
    try {
        box_->begin();
    } catch (const Error&) { // then it is lost, or times by its clock stay as they are known
    }
}

bool ThreadedButtonBox::poll(ButtonChange& into) noexcept {
    if (thread_.joinable())
        return changes_.try_pop(into);
    if (box_->poll({&into, 1}) == 1)
        return true;
    if (box_->lost() && !is_lost_.exchange(true)) {
        lost_at_ = clock_.now();
        has_news_ = true;
    }
    return false;
}

void ThreadedButtonBox::read() noexcept {
    const std::lock_guard lock(box_mutex_);
    std::array<ButtonChange, 32> changes;
    for (std::size_t taken = changes.size(); taken == changes.size();) {
        taken = box_->poll(changes);
        for (std::size_t i = 0; i < taken; ++i)
            if (!changes_.try_push(changes[i]))
                ++forgotten_;
    }
    // Boxes without a clock have nothing to read.
    if (begins_.exchange(false) && description_.has_clock)
        begin_now();
    is_lost_ = box_->lost();
}

void ThreadedButtonBox::look_for_it(const std::stop_token& stop) noexcept {
    const SessionTime then = clock_.now() + look_again_after_;
    while (!stop.stop_requested() && clock_.now() < then)
        clock_.wait_until(std::min(then, clock_.now() + patient_interval));
    if (stop.stop_requested())
        return;
    try {
        {
            const std::lock_guard lock(box_mutex_);
            box_.reset(); // a port that is still held cannot be opened
        }
        std::unique_ptr<ButtonBox> found = open_();
        const std::lock_guard lock(box_mutex_);
        box_ = std::move(found);
    } catch (const Error&) { // not yet
        return;
    }
    tell(false, box_->description().model);
    is_lost_ = false;
}

} // namespace overt
