#include <fmt/format.h>

#include "experiment/protocol/protocol.h"

namespace overt {

namespace {

class OwnLevelsOf {
  public:
    explicit OwnLevelsOf(const Protocol& protocol) : protocol_(protocol) {}

    void add_task(int task) {
        const Task& settings = protocol_.tasks[static_cast<std::size_t>(task)];
        for (const int table : {settings.trials.table, settings.catch_trials.table})
            if (table >= 0)
                add_table(protocol_.trial_tables[static_cast<std::size_t>(table)]);
        for (const ProbeSettings& probe : settings.probes)
            add_probe(probe);
        if (settings.trials.rule)
            add_rule(task, settings.trials, row_of(*settings.trials.rule));
    }
    void add(std::string_view name, std::string_view level) { own_.add(name, level); }
    const std::vector<NamedWord>& levels() const { return own_.levels(); }

  private:
    void add_table(const TrialTable& table) {
        for (const TrialTableRow& row : table.rows) {
            for (const TrialLevel& of : row.levels)
                add(of.factor, of.level);
            add(correct_answer, row.correct);
        }
    }
    void add_probe(const ProbeSettings& probe) {
        for (const PointListSettings& list : protocol_.point_lists)
            for (int i = 0; list.id == probe.points && i < list.count(); ++i)
                add(probe.id, list.name_of(i));
    }
    void add_rule(int task, const TrialsSettings& trials, const TrialRuleRow& rule) {
        for (const std::string_view answer : rule.answers)
            add(correct_answer, answer);
        const std::vector<int> slots = slots_of_task(protocol_, task);
        for (const int slot : slots) {
            const std::string& id = protocol_.slots[static_cast<std::size_t>(slot)].id;
            if (rule.has_key("side") && slots.size() > 1)
                add("side", id);
            if (rule.has_key("among"))
                add(correct_answer, id);
        }
        if (rule.has_key("lures") && trials.lures)
            for (const std::string_view level : {"none", "lure"})
                add("lure", level);
        if (!rule.has_key("set_sizes"))
            return;
        for (const std::string_view answer : rule.answers)
            add("target", answer);
        for (const double size : trials.set_sizes)
            add("set_size", fmt::format("{}", size));
        if (trials.set_sizes.empty())
            add("set_size", fmt::format("{}", slots.size()));
    }

    const Protocol& protocol_;
    OwnLevels own_;
};

} // namespace

std::vector<NamedWord> own_levels_of(const Protocol& protocol) {
    OwnLevelsOf own(protocol);
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task)
        own.add_task(task);
    for (const BlockSettings& block : protocol.blocks)
        for (const std::string_view seen : {"old", "new"})
            if (!block.draw.from.empty()) {
                own.add("seen", seen);
                own.add(correct_answer, seen);
            }
    return own.levels();
}

} // namespace overt
