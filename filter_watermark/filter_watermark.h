// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "filter.h"

/// What MeshLab loads. No algorithm lives here: each filter is a Filter, in a file of its own.
class FilterWatermark : public HostPlugin {
    Q_OBJECT
    HOST_PLUGIN

public:
    FilterWatermark();

    QString pluginName() const override { return "FilterWatermark"; }
    QString filterName(int id) const override { return all_filters.at(id)->name; }
    QString pythonFilterName(int id) const override { return all_filters.at(id)->python_name; }
    QString filterInfo(int id) const override { return all_filters.at(id)->info(); }
    FilterClass menu(int id) const override { return all_filters.at(id)->menu; }
    FilterArity arity(int id) const override { return all_filters.at(id)->arity; }
    int changes(int id) const override { return all_filters.at(id)->changes; }
    RichParameterList parameters(int id, const MeshDocument& document) const override
    {
        return all_filters.at(id)->parameters(document);
    }
    HostResult run(int id, const RichParameterList& values, MeshDocument& document, vcg::CallBackPos* cb) override;
};
