/// How a task's trials are made of stimuli by a rule: all pairs, triads, a search among others. Pure: a rule
/// knows stimuli by their numbers, factors by the levels of these, and slots by their ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/base/random.h"

namespace overt {

/// Which slot each member of a trial takes.
enum class SideRule : std::uint8_t {
    drawn,   ///< by chance, each way equally often to one
    crossed, ///< each way once
    fixed    ///< in the order of the rule
};
template <> inline constexpr auto names_of<SideRule> = enum_names<SideRule>("drawn", "crossed", "fixed");

/// For whom lists and sides are drawn.
enum class DrawnFor : std::uint8_t { observer, everyone };
template <> inline constexpr auto names_of<DrawnFor> = enum_names<DrawnFor>("observer", "everyone");

/// A factor that a rule speaks of.
struct RuleFactor {
    std::string name;
    std::vector<std::string> levels; ///< numbers from the smallest up, others as listed
    std::vector<int> of_stimulus;    ///< by stimulus: its level, from 0; -1 where it has none
};

/// What a rule is asked for. Which of it a rule looks at, its row says.
struct RuleRequest {
    int stimuli = 0;          ///< numbered from 0
    std::vector<int> context; ///< by stimulus: what is alike in it is alike in all that a trial has in common
    std::vector<RuleFactor> of;      ///< in which the members of a trial differ
    std::vector<RuleFactor> differs; ///< in which they differ besides
    std::vector<std::string> slots;  ///< ids of the task's, in its order; at least one

    SideRule side = SideRule::drawn;
    std::optional<int> draw; ///< so many of all combinations, without replacement
    int repetitions = 1;
    bool is_ordered = false;                                  ///< a pair comes both ways round
    bool with_identical = false;                              ///< a stimulus is paired with itself, too
    std::vector<std::string> standards, targets, distractors; ///< levels of the first of `of`
    int size = 0;                                             ///< of tuples; 0: the number of slots
    std::vector<int> set_sizes;                               ///< of a search
    double absent = 0.5;                                      ///< share of trials without the target
    std::string in;                 ///< slot of a single stimulus; empty: the only one
    std::string sample;             ///< slot; empty: the first
    std::vector<std::string> among; ///< slots; empty: all others
    int length = 0, back = 1;       ///< of a stream
    double repeats = 0.25;          ///< share of the trials of a stream that can repeat
    /// Of a stream: share of the same trials that are what came one trial earlier or later than `back`
    /// before, and not `back` before; nothing: as chance has it.
    std::optional<double> lures;
    int procedure_trials = 0; ///< of all procedures of the task, in each context
};

/// A trial as a rule gives it.
struct RuledTrial {
    std::vector<int> shown;  ///< by slot of the task: a stimulus; -1: it stays empty
    std::optional<int> side; ///< the slot of the member that the rule names first, where slots change
    std::string correct;     ///< the correct answer, where the rule knows one
    std::vector<std::pair<std::string, std::string>> levels; ///< of factors that the rule brings along
    friend bool operator==(const RuledTrial&, const RuledTrial&) = default;
};

/// Why there is nothing that a rule could give. `key` is that of the request that is to be changed.
struct RuleProblem {
    std::string_view key;
    std::string message;
    std::string hint;
};

/// Members of trials: each combination is so many numbers.
class Combinations {
  public:
    /// More than anybody draws from.
    static constexpr std::size_t most = 4'000'000;

    explicit Combinations(std::size_t width) : width_(width) {}
    std::size_t size() const { return numbers_.size() / width_; }
    bool is_full() const { return size() >= most; }
    /// Does nothing once it is full.
    void add(std::span<const int> combination) {
        if (!is_full())
            numbers_.insert(numbers_.end(), combination.begin(), combination.end());
    }
    std::span<const int> at(std::size_t index) const {
        return std::span(numbers_).subspan(index * width_, width_);
    }

  private:
    std::size_t width_;
    std::vector<int> numbers_;
};

/// One rule with one request, which outlives it.
class TrialRule {
  public:
    explicit TrialRule(const RuleRequest& request) : request_(request) {}
    virtual ~TrialRule() = default;
    TrialRule(const TrialRule&) = delete;
    TrialRule& operator=(const TrialRule&) = delete;

    /// What of the request contradicts the rule; the rest is asked for only where there is nothing.
    virtual std::vector<RuleProblem> problems() const = 0;

    /// How many trials trials() gives; 0: the rule finds nothing to combine.
    virtual std::size_t count() const = 0;

    /// How many there are to draw from.
    virtual std::size_t available() const = 0;

    /// The trials, in the order of the lists. What is drawn is drawn of `random`.
    virtual std::vector<RuledTrial> trials(RandomStream& random) const = 0;

  protected:
    const RuleRequest& request() const { return request_; }

  private:
    const RuleRequest& request_;
};

/// A rule that combines members in all possible ways, and puts each combination into the slots.
class CombiningRule : public TrialRule {
  public:
    using TrialRule::TrialRule;
    std::size_t count() const override;
    std::size_t available() const override { return combinations().size(); }
    std::vector<RuledTrial> trials(RandomStream& random) const override;

  protected:
    /// Each combination once, the member that the rule names first in front.
    virtual Combinations combinations() const = 0;
    /// In how many ways a combination goes into the slots where they are crossed; 1: sides say nothing.
    virtual int ways() const { return 1; }
    /// The same where they are drawn.
    virtual int drawn_ways() const { return ways(); }
    /// `way` counts from 0, which is the fixed one.
    virtual RuledTrial place(std::span<const int> combination, int way, RandomStream& random) const = 0;
};

// What rules have in common.

/// The stimuli of each context, in the order of the levels of `of`.
std::vector<std::vector<int>> stimuli_by_context(const RuleRequest& request);

/// Whether two stimuli differ in each of these factors. One without a level differs from nothing.
bool do_differ(std::span<const RuleFactor> factors, int one, int other);

/// A problem if the task has not so many slots.
void require_slots(const RuleRequest& request, std::size_t count, std::string_view rule,
                   std::vector<RuleProblem>& problems);
/// A problem for each of `named` that is no level of the first factor; if there are none, and `of` is not one
/// factor.
void require_levels(const RuleRequest& request, std::string_view key, std::span<const std::string> named,
                    std::vector<RuleProblem>& problems);
/// A problem if `of` is not one factor alone.
void require_one_factor(const RuleRequest& request, std::string_view rule,
                        std::vector<RuleProblem>& problems);
/// A problem if a slot is none of the task's.
void require_slot(const RuleRequest& request, std::string_view key, const std::string& slot,
                  std::vector<RuleProblem>& problems);
/// Index of a slot of the task that there is.
int slot_called(const RuleRequest& request, std::string_view id);

/// Whether a stimulus has one of these levels of the first factor.
bool has_level(const RuleRequest& request, int stimulus, std::span<const std::string> named);

} // namespace overt
