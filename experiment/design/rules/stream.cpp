#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Draws of a stream in which all lures found something to lure with.
constexpr int most_draws = 1000;

/// n-back: whether a stimulus repeats the one `back` trials before. Exactly so many do as the share says; all
/// others are drawn evenly from those that do not. Lures are what came one trial earlier or later than that;
/// where a share is asked for, so many are, as far as that can be, and the rest is drawn from what is
/// neither.
class StreamRule : public TrialRule {
  public:
    using TrialRule::TrialRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_slots(request(), 1, "stream", found);
        if (request().length <= request().back)
            found.push_back({request().length == 0 ? "rule" : "length",
                             fmt::format("a stream of {} trials holds nothing that came {} before",
                                         request().length, request().back),
                             "write length = N, longer than back"});
        if (request().lures && request().repeats + *request().lures > 1.0)
            found.push_back({"lures",
                             fmt::format("repeats and lures are {:g} of the trials together",
                                         request().repeats + *request().lures),
                             "together they can be 1 at most"});
        const auto is_too_small = [](const std::vector<int>& stimuli) { return stimuli.size() < 4; };
        if (request().lures && std::ranges::any_of(stimuli_by_context(request()), is_too_small))
            found.push_back(
                {"lures", "of fewer than four stimuli some are always lures", "name four at least"});
        if (std::ranges::any_of(stimuli_by_context(request()),
                                [](const std::vector<int>& stimuli) { return stimuli.size() == 1; }))
            found.push_back({"of", "a stream of a single stimulus repeats it always", "name two at least"});
        return found;
    }

    std::size_t count() const override {
        return stimuli_by_context(request()).size() * static_cast<std::size_t>(request().length) *
               static_cast<std::size_t>(request().repetitions);
    }

    std::size_t available() const override { return count(); }

    std::vector<RuledTrial> trials(RandomStream& random) const override {
        std::vector<RuledTrial> all;
        for (int repetition = 0; repetition < request().repetitions; ++repetition)
            for (const std::vector<int>& stimuli : stimuli_by_context(request()))
                add_stream(stimuli, random, all);
        return all;
    }

  private:
    enum class Kind : std::uint8_t { fresh, repeat, lure };
    struct Drawn {
        std::vector<std::size_t> places; ///< in the stimuli, by trial
        std::vector<Kind> kinds;
        int failed_lures = 0;
    };

    void add_stream(const std::vector<int>& stimuli, RandomStream& random,
                    std::vector<RuledTrial>& all) const {
        Drawn drawn = draw(stimuli.size(), random);
        for (int draws = 1; drawn.failed_lures > 0 && draws < most_draws; ++draws)
            if (Drawn other = draw(stimuli.size(), random); other.failed_lures < drawn.failed_lures)
                drawn = std::move(other);
        for (std::size_t i = 0; i < drawn.places.size(); ++i) {
            RuledTrial trial;
            trial.shown = {stimuli[drawn.places[i]]};
            trial.correct = drawn.kinds[i] == Kind::repeat ? "repeat" : "new";
            if (request().lures)
                trial.levels = {{"lure", drawn.kinds[i] == Kind::lure ? "lure" : "none"}};
            all.push_back(std::move(trial));
        }
    }

    Drawn draw(std::size_t stimuli, RandomStream& random) const {
        const auto length = static_cast<std::size_t>(request().length);
        const auto back = static_cast<std::size_t>(request().back);
        std::vector<Kind> kinds(length - back, Kind::fresh);
        const auto share_of = [&](double share) {
            return std::lround(share * static_cast<double>(kinds.size()));
        };
        const auto repeats = std::fill_n(kinds.begin(), share_of(request().repeats), Kind::repeat);
        std::fill_n(repeats, std::min(share_of(request().lures.value_or(0.0)), kinds.end() - repeats),
                    Kind::lure);
        random.shuffle(std::span(kinds));
        kinds.insert(kinds.begin(), back, Kind::fresh);
        Drawn drawn{{}, std::move(kinds), 0};
        for (std::size_t i = 0; i < length; ++i)
            drawn.places.push_back(next(drawn, i, stimuli, random));
        return drawn;
    }

    /// Places of a stream that `i` would be a lure with: those one trial earlier or later than `back` before.
    std::vector<std::size_t> lures_at(const Drawn& drawn, std::size_t i) const {
        const auto back = static_cast<std::size_t>(request().back);
        std::vector<std::size_t> lures;
        if (i > back)
            lures.push_back(drawn.places[i - back - 1]);
        if (back > 1 && i + 1 >= back)
            lures.push_back(drawn.places[i + 1 - back]);
        if (i >= back)
            std::erase(lures, drawn.places[i - back]);
        return lures;
    }

    std::size_t next(Drawn& drawn, std::size_t i, std::size_t stimuli, RandomStream& random) const {
        const auto back = static_cast<std::size_t>(request().back);
        const auto below = [&](std::size_t count) { return random.below(static_cast<std::uint32_t>(count)); };
        if (drawn.kinds[i] == Kind::repeat)
            return drawn.places[i - back];
        if (!request().lures) {
            // One of the others.
            return i < back ? below(stimuli) : (drawn.places[i - back] + 1 + below(stimuli - 1)) % stimuli;
        }
        const std::vector<std::size_t> lures = lures_at(drawn, i);
        if (drawn.kinds[i] == Kind::lure) {
            if (!lures.empty())
                return lures[below(lures.size())];
            drawn.kinds[i] = Kind::fresh;
            ++drawn.failed_lures;
        }
        std::vector<std::size_t> fresh;
        for (std::size_t place = 0; place < stimuli; ++place)
            if (std::ranges::find(lures, place) == lures.end() &&
                (i < back || place != drawn.places[i - back]))
                fresh.push_back(place);
        return fresh[below(fresh.size())];
    }
};

} // namespace

std::unique_ptr<TrialRule> stream_rule(const RuleRequest& request) {
    return std::make_unique<StreamRule>(request);
}

} // namespace overt
