#include "experiment/spectra/metal_table.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/number_table.h"

namespace overt {

namespace {

/// One line of the table: index at a wavelength.
struct MetalRow {
    double wavelength_nm = 0.0, n = 0.0, k = 0.0;
};

/// Which column holds what.
struct MetalColumns {
    std::size_t wavelength = 0, n = 0, k = 0;
    double nm_per_unit = 1.0;
    bool are_bins = false;
};

class MetalFile {
  public:
    /// `text` outlives it.
    MetalFile(std::filesystem::path file, std::string_view text) : file_(std::move(file)), lines_(text) {}

    ComplexIndex read() {
        while (lines_.next())
            columns_ ? add_row() : read_header();
        if (!columns_)
            fail("there is no line that names the columns: wavelength_nm,n,k");
        return columns_->are_bins ? bins_as_they_are() : bin_means();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("{}:{}: {}", file_.string(), lines_.number(), message));
    }

    void read_header() {
        const std::vector<TableCell>& names = lines_.cells();
        const auto column = [&](std::string_view name) -> std::optional<std::size_t> {
            const auto found = std::ranges::find(names, name, &TableCell::text);
            return found == names.end() ? std::nullopt
                                        : std::optional(static_cast<std::size_t>(found - names.begin()));
        };
        MetalColumns columns;
        if (const auto centre = column("centre_nm")) {
            columns.wavelength = *centre;
            columns.are_bins = true;
        } else if (const auto nm = column("wavelength_nm")) {
            columns.wavelength = *nm;
        } else if (const auto um = column("wavelength_um")) {
            columns.wavelength = *um;
            columns.nm_per_unit = 1000.0;
        } else {
            fail("no column is called centre_nm, wavelength_nm or wavelength_um");
        }
        const auto n = column("n"), k = column("k");
        if (!n || !k)
            fail("the columns n and k are needed: refractive index and extinction coefficient");
        columns.n = *n;
        columns.k = *k;
        columns_ = columns;
    }

    double number(std::size_t column) const {
        if (column >= lines_.cells().size())
            fail(fmt::format("the line has {} columns only", lines_.cells().size()));
        const TableCell& cell = lines_.cells()[column];
        const std::optional<double> value = cell.number();
        if (!value)
            fail(fmt::format("\"{}\" is no number", cell.text));
        return *value;
    }

    void add_row() {
        const MetalRow row{number(columns_->wavelength) * columns_->nm_per_unit, number(columns_->n),
                           number(columns_->k)};
        if (row.n < 0.0 || row.k < 0.0 || row.n > 100.0 || row.k > 100.0 || row.n + row.k == 0.0)
            fail("n and k of a metal lie between 0 and 100, and are not both 0");
        if (!rows_.empty() && row.wavelength_nm <= rows_.back().wavelength_nm)
            fail("wavelengths must rise from line to line");
        if (columns_->are_bins &&
            row.wavelength_nm != first_bin_centre_nm + bin_width_nm * static_cast<double>(rows_.size()))
            fail("the centres must be 400, 410 … 700 nm; name the column wavelength_nm for others");
        rows_.push_back(row);
    }

    ComplexIndex bins_as_they_are() const {
        if (rows_.size() != spectral_bins)
            fail(fmt::format("{} bins, but 31 are needed: 400, 410 … 700 nm", rows_.size()));
        ComplexIndex metal;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            metal.n[bin] = rows_[bin].n;
            metal.k[bin] = rows_[bin].k;
        }
        return metal;
    }

    ComplexIndex bin_means() const {
        const double low = first_bin_centre_nm - 0.5 * bin_width_nm;
        const double high = low + bin_width_nm * spectral_bins;
        if (rows_.empty() || rows_.front().wavelength_nm > low || rows_.back().wavelength_nm < high)
            fail(fmt::format("the wavelengths do not cover {} to {} nm", low, high));
        ComplexIndex metal;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const double from = low + bin_width_nm * static_cast<double>(bin);
            metal.n[bin] = mean_between(from, from + bin_width_nm, &MetalRow::n);
            metal.k[bin] = mean_between(from, from + bin_width_nm, &MetalRow::k);
        }
        return metal;
    }

    double mean_between(double low, double high, double MetalRow::*value) const {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
            const MetalRow &a = rows_[i], &b = rows_[i + 1];
            const double from = std::max(low, a.wavelength_nm), to = std::min(high, b.wavelength_nm);
            if (from >= to)
                continue;
            const double share = (0.5 * (from + to) - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
            sum += (to - from) * (a.*value + share * (b.*value - a.*value));
        }
        return sum / (high - low);
    }

    std::filesystem::path file_;
    TableLines lines_;
    std::optional<MetalColumns> columns_;
    std::vector<MetalRow> rows_;
};

} // namespace

bool is_metal_file(const std::string& metal) { return std::filesystem::path(metal).extension() == ".csv"; }

ComplexIndex read_metal_table(const std::filesystem::path& file) {
    Diagnostics ignored;
    const auto text = read_whole_file(file, file.string(), {}, ignored);
    if (!text)
        throw InputError(fmt::format("{}: cannot be read as a table of a metal", file.string()));
    return MetalFile(file, *text).read();
}

ComplexIndex load_metal(const std::string& metal) {
    return is_metal_file(metal) ? read_metal_table(metal) : metal_index(metal);
}

} // namespace overt
