#include "experiment/watch/view_news.h"

#include <algorithm>

#include "experiment/ports/event_kinds.h"

namespace overt {

namespace {

template <std::size_t size> void set(std::array<char, size>& into, std::string_view from) noexcept {
    std::size_t length = std::min(from.size(), size - 1);
    if (length < from.size())
        while (length > 0 && (static_cast<unsigned char>(from[length]) & 0xC0u) == 0x80u)
            --length;
    std::copy_n(from.begin(), length, into.begin());
    into[length] = '\0';
}

} // namespace

void ViewNews::set_word(std::string_view from) noexcept { set(word, from); }
void ViewNews::set_text(std::string_view from) noexcept { set(text, from); }

ViewBuilder::ViewBuilder(std::vector<ViewedTrial> trials, int completed, std::vector<ViewedSlot> slots)
    : trials_(std::move(trials)), slots_(std::move(slots)) {
    view_.phase = name_of(SessionPhase::set_up);
    view_.done = view_.done_before = completed;
}

std::optional<ViewedEvent> ViewBuilder::apply(const ViewNews& news) {
    view_.time_s = std::max(view_.time_s, to_seconds(news.at));
    switch (news.kind) {
    case ViewNews::Kind::phase:
        view_.phase = name_of(news.phase);
        view_.trial = news.trial;
        nothing_lit(news.at);
        view_.asks.clear();
        view_.level_rms.reset();
        view_.level_peak.reset();
        return std::nullopt;
    case ViewNews::Kind::trial_started:
        view_.trial = news.trial;
        if (!view_.first_trial_s)
            view_.first_trial_s = to_seconds(news.at);
        view_.samples_in_trial = view_.lost_in_trial = view_.missed_in_trial = 0;
        view_.refresh = 0;
        if (news.trial >= 0 && static_cast<std::size_t>(news.trial) < trials_.size()) {
            const ViewedTrial& trial = trials_[static_cast<std::size_t>(news.trial)];
            view_.task = trial.task;
            view_.question = trial.question;
            view_.shown = trial.shown;
            for (std::size_t i = 0; i < view_.shown.size() && i < trial.picture_of_frame.size(); ++i)
                if (const std::vector<int>& pictures = trial.picture_of_frame[i]; !pictures.empty())
                    view_.shown[i].pictures = 1 + std::ranges::max(pictures);
            lit_.assign(view_.shown.size(), {});
        }
        return std::nullopt;
    case ViewNews::Kind::trial_ended:
        ++(news.counts ? view_.done : view_.failed);
        view_.answer = news.text.data();
        if (news.has_value)
            view_.drift_deg = news.value;
        nothing_lit(news.at);
        break;
    case ViewNews::Kind::flip:
        if (const auto shown = static_cast<std::size_t>(news.shown); shown < view_.shown.size()) {
            lit(news.at, shown, news.pose);
            view_.shown[shown].picture = picture_of(shown, news.frame);
        }
        view_.refresh = news.refresh;
        view_.missed = news.missed;
        view_.missed_in_trial = news.missed_in_trial;
        return std::nullopt;
    case ViewNews::Kind::samples:
        break;
    case ViewNews::Kind::validation:
        view_.validation_mean_deg = news.value;
        view_.validation_max_deg = news.other;
        return std::nullopt;
    case ViewNews::Kind::level:
        view_.level_rms = news.value;
        view_.level_peak = news.other;
        view_.is_clipping = news.counts;
        return std::nullopt;
    case ViewNews::Kind::event:
    case ViewNews::Kind::reply: {
        const bool is_reply = news.kind == ViewNews::Kind::reply;
        ViewedEvent event{to_seconds(news.at), news.trial,
                          is_reply ? "operator's view" : std::string(news.word.data()), news.text.data()};
        if (!is_reply)
            apply_event(event);
        // A change of phase is shown as such.
        return event.kind == phase_event ? std::nullopt : std::optional(std::move(event));
    }
    }
    // These and the end of a trial bring the counts of samples.
    view_.samples = news.samples;
    view_.lost = news.lost;
    view_.samples_in_trial = news.samples_in_trial;
    view_.lost_in_trial = news.lost_in_trial;
    if (news.kind == ViewNews::Kind::trial_ended) {
        view_.missed = news.missed;
        view_.missed_in_trial = news.missed_in_trial;
    }
    return std::nullopt;
}

int ViewBuilder::picture_of(std::size_t shown, int frame) const {
    if (view_.trial < 0 || static_cast<std::size_t>(view_.trial) >= trials_.size() || frame < 0)
        return -1;
    const auto& all = trials_[static_cast<std::size_t>(view_.trial)].picture_of_frame;
    if (shown >= all.size() || static_cast<std::size_t>(frame) >= all[shown].size())
        return -1;
    return all[shown][static_cast<std::size_t>(frame)];
}

void ViewBuilder::lit(SessionTime since, std::size_t shown, int pose) {
    view_.shown[shown].pose = pose;
    auto& last = lit_[shown];
    std::rotate(last.begin(), last.end() - 1, last.end());
    last.front() = {since, pose};
}

void ViewBuilder::nothing_lit(SessionTime since) {
    for (std::size_t shown = 0; shown < view_.shown.size(); ++shown)
        lit(since, shown, -1);
}

ViewedGaze ViewBuilder::placed(const GazeNews& gaze) const {
    ViewedGaze placed{gaze.is_right,
                      gaze.has_place ? std::optional(gaze.place) : std::nullopt,
                      view_.trial,
                      -1,
                      -1,
                      to_seconds(gaze.at),
                      gaze.sampled_at.time_since_epoch().count()};
    for (std::size_t shown = 0; shown < lit_.size(); ++shown) {
        const auto then =
            std::ranges::find_if(lit_[shown], [&](const Lit& one) { return one.since <= gaze.at; });
        if (then == lit_[shown].end() || then->pose < 0)
            continue;
        const auto slot = static_cast<std::size_t>(view_.shown[shown].slot);
        if (slot < slots_.size() && !(gaze.has_place && slots_[slot].holds(gaze.place)))
            continue;
        placed.shown = static_cast<int>(shown);
        placed.pose = then->pose;
        break;
    }
    return placed;
}

void ViewBuilder::apply_event(const ViewedEvent& event) {
    if (event.kind == operator_asked_event)
        view_.asks = event.detail;
    else if (event.kind == operator_answered_event)
        view_.asks.clear();
    else if (event.kind == tracker_lost_event)
        view_.tracker_is_lost = true;
    else if (event.kind == tracker_regained_event)
        view_.tracker_is_lost = false;
}

} // namespace overt
