// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "filter.h"

#include <QSaveFile>
#include <vcg_ext/attack/attack.h>
#include <vcg_ext/metric/distortion.h>
#include <vcg_ext/watermark/watermark.h>

/// The results under the names that scripts rely on.
Json to_json(const vcg_ext::EmbedReport& report, const std::vector<vcg_ext::Rehearsal>& rehearsals);
Json to_json(const vcg_ext::DetectReport& report);
Json to_json(const vcg_ext::AttackReport& report);
Json to_json(const vcg_ext::DistortionReport& report);

/// The same for pymeshlab's dict, which cannot take texts: `bits` becomes a vector of 0 and 1, `warnings` their count,
/// `seconds`, `solver`, `moves` and `registration` a value for each part (`seconds_placement`). Other texts are in the log and the
/// report only.
std::map<std::string, HostValue> to_values(const Json& results);

/// The same for the log: a line each, long lists by their range. Warnings are left out.
QStringList to_lines(const Json& results);

/// A result on its way to a file. Nothing of it is seen until all of it is there.
class OutputFile {
public:
    /// \param parameter that names the file  \throw Error where it cannot be written
    OutputFile(const RichParameterList& values, const QString& parameter);

    /// Whether the parameter names a file at all.
    bool wanted() const { return file_.isOpen(); }

    /// Puts the file in its place. \throw Error where the disk is full, say
    void write(const std::string& bytes);

private:
    [[noreturn]] void fail(const QString& reason) const;

    QString parameter_;
    QSaveFile file_;
};

/// The results as JSON, in the file that the parameter Report names.
class ReportFile : private OutputFile {
public:
    explicit ReportFile(const RichParameterList& values) : OutputFile(values, "Report") {}

    void write(const Json& results) { OutputFile::write(results.dump(2) + "\n"); }
};
