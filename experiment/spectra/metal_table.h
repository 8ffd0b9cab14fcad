/// The complex refractive index of a metal as a laboratory has it: a table in a file.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/spectra/spectra.h"

namespace overt {

/// Whether a protocol's `metal` names a file (it ends in .csv) and not one of the metals known.
bool is_metal_file(const std::string& metal);

/// Reads a comma-separated table. Lines that begin with # are passed over; the first other line names the
/// columns, among them `n` and `k` and one of `centre_nm`, `wavelength_nm` and `wavelength_um`; further
/// columns are passed over. With `centre_nm` the 31 rows are the bins themselves, 400 to 700 nm; else at
/// least the range from 395 to 705 nm must be covered by rising wavelengths, and a bin is the mean of the
/// straight lines between them. Throws InputError naming file and line.
ComplexIndex read_metal_table(const std::filesystem::path& file);

/// The metal of a name that metal_index knows, or of a file.
ComplexIndex load_metal(const std::string& metal);

} // namespace overt
