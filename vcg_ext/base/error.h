// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>

namespace vcg_ext {

/// What the library throws at bad input: one text that names the cause and the cure.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace vcg_ext
