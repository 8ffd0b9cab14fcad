#include "experiment/report/report_page.h"

#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "report_assets.h"

namespace overt {
namespace {

void put_in_place(std::string& page, std::string_view mark, std::string_view text) {
    const std::size_t at = page.find(mark);
    OVERT_EXPECTS(at != std::string::npos);
    page.replace(at, mark.size(), text);
}

// A script ends at the first "</", whatever it stands in; JSON may have it as "<\/".
std::string within_script(std::string json) {
    for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 3))
        json.replace(at, 2, "<\\/");
    for (std::size_t at = json.find("<!"); at != std::string::npos; at = json.find("<!", at + 6))
        json.replace(at, 2, "\\u003c!");
    return json;
}

std::string within_html(std::string_view text) {
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '{' ? "&#123;" : std::string(1, c);
    return safe;
}

} // namespace

std::string report_page(const StudyResults& results) {
    using nlohmann::ordered_json;
    // Texts of sessions may hold bytes that are no UTF-8.
    const std::string data =
        report_data(results).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    std::string page(embedded::report_html);
    // The data last: whatever a session's texts hold, no mark is looked for in them.
    put_in_place(page, "{{TITLE}}", within_html(results.glance.title));
    put_in_place(page, "{{STYLE}}", embedded::report_css);
    put_in_place(page, "{{THREE}}", embedded::three_min_js);
    std::string script;
    for (const std::string_view part :
         {embedded::report_draw_js, embedded::report_table_js, embedded::report_views_js, embedded::report_js,
          embedded::report_trends_js, embedded::report_answers_js, embedded::report_maps_js,
          embedded::report_trials_js, embedded::report_explorations_js, embedded::report_points_js,
          embedded::report_looking_js, embedded::report_areas_js, embedded::report_order_js,
          embedded::report_save_js})
        script += part;
    put_in_place(page, "{{SCRIPT}}", script);
    put_in_place(page, "{{DATA}}", within_script(data));
    return page;
}

void write_report(const StudyResults& results, const std::filesystem::path& file) {
    write_whole_file(file, report_page(results));
}

} // namespace overt
