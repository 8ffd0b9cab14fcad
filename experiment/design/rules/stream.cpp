#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// n-back: whether a stimulus repeats the one `back` trials before. Exactly so many do as the share says; all
/// others are drawn evenly from those that do not.
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
    void add_stream(const std::vector<int>& stimuli, RandomStream& random,
                    std::vector<RuledTrial>& all) const {
        const auto length = static_cast<std::size_t>(request().length);
        const auto back = static_cast<std::size_t>(request().back);
        std::vector<int> does_repeat(length - back, 0);
        const auto count = static_cast<std::size_t>(
            std::lround(request().repeats * static_cast<double>(does_repeat.size())));
        std::fill_n(does_repeat.begin(), count, 1);
        random.shuffle(std::span(does_repeat));
        std::vector<std::size_t> stream; // places in `stimuli`
        for (std::size_t i = 0; i < length; ++i) {
            const bool repeats = i >= back && does_repeat[i - back] == 1;
            std::size_t next = i >= back ? stream[i - back] : 0;
            if (i < back) {
                next = random.below(static_cast<std::uint32_t>(stimuli.size()));
            } else if (!repeats) {
                // One of the others.
                next += 1 + random.below(static_cast<std::uint32_t>(stimuli.size() - 1));
                next %= stimuli.size();
            }
            stream.push_back(next);
            RuledTrial trial;
            trial.shown = {stimuli[next]};
            trial.correct = repeats ? "repeat" : "new";
            all.push_back(std::move(trial));
        }
    }
};

} // namespace

std::unique_ptr<TrialRule> stream_rule(const RuleRequest& request) {
    return std::make_unique<StreamRule>(request);
}

} // namespace overt
