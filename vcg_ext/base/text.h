#pragma once
#include <string>

namespace vcg_ext {

/// A number for people, six significant digits: 0.1, 1e-07, 15.
[[nodiscard]] std::string text(double number);

} // namespace vcg_ext
