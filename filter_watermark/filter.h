// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"

#include <nlohmann/json.hpp>
#include <vcg_ext/base/error.h>
#include <vcg_ext/base/progress.h>

#include <array>

/// What a filter answers: names and values in the order in which people read them.
using Json = nlohmann::ordered_json;

/// One filter of the plugin: what MeshLab wants to know of it, and what it does.
struct Filter {
    const char* name;                ///< in menus and .mlx
    const char* python_name;         ///< in pymeshlab
    HostInterface::FilterClass menu; ///< submenu
    FilterArity arity;               ///< how many layers it works on
    int changes;                     ///< MeshModel's mask of what it may change
    QString (*info)();               ///< HTML, at the top of the dialog
    RichParameterList (*parameters)(const MeshDocument& document);

    /// Changes the current layer and returns the results.
    /// \throw vcg_ext::Error with cause and cure; the document is then as it was
    Json (*run)(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress);
};

extern const Filter embed_filter;
extern const Filter detect_filter;
extern const Filter original_filter;
extern const Filter attack_filter;
extern const Filter measure_filter;

/// All filters; a filter's place here is its id.
inline const std::array<const Filter*, 5> all_filters = {&embed_filter, &detect_filter, &original_filter,
                                                         &attack_filter, &measure_filter};
