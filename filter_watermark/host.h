// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// Every difference between MeshLab 2020.09 and 2025.07, and nothing else.
///
/// CMake sets MESHLAB_YEAR, MESHLAB_SCALAR and MESHLAB_VERSION from the source tree that it builds against.

#if MESHLAB_YEAR < 2021
#include <common/interfaces.h>
#else
#include <common/plugins/interfaces/filter_plugin.h>
#endif

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

/// What pymeshlab can return.
using HostValue = std::variant<bool, int, double, std::vector<double>>;

/// What one run of a filter gives to its host.
struct HostResult {
    std::map<std::string, HostValue> values; ///< pymeshlab returns them as a dict
    QStringList log;                         ///< lines for people
    QStringList warnings;
    QString error; ///< empty where all went well
};

#if MESHLAB_YEAR < 2021

#define HOST_PLUGIN                                                                                                    \
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)                                                             \
    Q_INTERFACES(MeshFilterInterface)

using HostInterface = MeshFilterInterface;
using FilterArity = MeshFilterInterface::FILTER_ARITY;
using RichFileSave = RichSaveFile;
using RichFileOpen = RichOpenFile;

#else

#define HOST_PLUGIN                                                                                                    \
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)                                                                     \
    Q_INTERFACES(FilterPlugin)

using HostInterface = FilterPlugin;
using FilterArity = FilterPlugin::FilterArity;

#endif

/// The plugin as its host calls it; turns these calls into the few that FilterWatermark answers.
class HostPlugin : public QObject, public HostInterface {
public:
    virtual FilterClass menu(int id) const = 0;
    virtual FilterArity arity(int id) const = 0;
    virtual int changes(int id) const = 0;
    virtual RichParameterList parameters(int id, const MeshDocument& document) const = 0;
    virtual HostResult run(int id, const RichParameterList& values, MeshDocument& document, vcg::CallBackPos* cb) = 0;

#if MESHLAB_YEAR < 2021
    virtual QString pythonFilterName(int id) const = 0;

    FilterClass getClass(QAction* action) override
    {
        return menu(ID(action));
    }
    FilterArity filterArity(QAction* action) const override
    {
        return arity(ID(action));
    }
    int postCondition(QAction* action) const override
    {
        return changes(ID(action));
    }
    void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& list) override
    {
        list = parameters(ID(action), document);
    }
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& values,
                     vcg::CallBackPos* cb) override
    {
        const HostResult result = run(ID(action), values, document, cb);
        write_log(result);
        errorMessage = result.error.toHtmlEscaped();
        return result.error.isEmpty();
    }

private:
    void line(GLLogStream::Levels level, const QString& text)
    {
        Log(level, text.toUtf8().constData());
    }
#else
    FilterClass getClass(const QAction* action) const override
    {
        return menu(ID(action));
    }
    FilterArity filterArity(const QAction* action) const override
    {
        return arity(ID(action));
    }
    int postCondition(const QAction* action) const override
    {
        return changes(ID(action));
    }
    RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override
    {
        return parameters(ID(action), document);
    }
    std::map<std::string, QVariant> applyFilter(const QAction* action, const RichParameterList& parameters,
                                                MeshDocument& document, unsigned int&, vcg::CallBackPos* cb) override
    {
        const HostResult result = run(ID(action), parameters, document, cb);
        write_log(result);
        if (!result.error.isEmpty())
            throw MLException(result.error);
        std::map<std::string, QVariant> values;
        for (const auto& [name, value] : result.values)
            values[name] = std::visit(ToVariant(), value);
        return values;
    }

private:
    struct ToVariant {
        template <class Plain>
        QVariant operator()(Plain value) const
        {
            return value;
        }
        QVariant operator()(const std::vector<double>& vector) const
        {
            return QVariant::fromValue<Eigen::VectorXd>(
                Eigen::Map<const Eigen::VectorXd>(vector.data(), Eigen::Index(vector.size())));
        }
    };

    void line(GLLogStream::Levels level, const QString& text)
    {
        log(level, text.toUtf8().constData());
    }
#endif

    /// Nobody hears of an error in meshlabserver unless the log has it.
    void write_log(const HostResult& result)
    {
        for (const QString& text : result.log)
            line(GLLogStream::FILTER, text);
        for (const QString& text : result.warnings)
            line(GLLogStream::WARNING, "Warning: " + text);
        if (!result.error.isEmpty())
            line(GLLogStream::WARNING, "Error: " + result.error);
    }
};

/// The current layer, or null where the document has none.
inline const MeshModel* current_layer(const MeshDocument& document)
{
#if MESHLAB_YEAR < 2021
    return const_cast<MeshDocument&>(document).mm();
#else
    return document.mm();
#endif
}

/// How many layers are seen.
inline int visible_layers(const MeshDocument& document)
{
    int count = 0;
#if MESHLAB_YEAR < 2021
    for (const MeshModel* layer : document.meshList)
        count += layer->isVisible();
#else
    for (const MeshModel& layer : document.meshIterator())
        count += layer.isVisible();
#endif
    return count;
}

/// A parameter that names a layer; one that is not the current one is preset where there is any.
inline RichMesh layer_parameter(const QString& name, const MeshDocument& document, const QString& label,
                                const QString& tip)
{
    const MeshModel* preset = current_layer(document);
#if MESHLAB_YEAR < 2021
    MeshDocument* list = const_cast<MeshDocument*>(&document);
    for (MeshModel* other : list->meshList)
        if (other != preset) {
            preset = other;
            break;
        }
    return preset ? RichMesh(name, const_cast<MeshModel*>(preset), list, label, tip)
                  : RichMesh(name, 0, list, label, tip);
#else
    for (auto other = document.meshBegin(); other != document.meshEnd(); ++other)
        if (&*other != preset) {
            preset = &*other;
            break;
        }
    return {name, preset ? unsigned(preset->id()) : 0, &document, label, tip};
#endif
}

/// The layer that such a parameter names, or null.
inline MeshModel* layer_value(const RichParameterList& values, const QString& name, MeshDocument& document)
{
#if MESHLAB_YEAR < 2021
    Q_UNUSED(document)
    return values.getMesh(name);
#else
    return document.getMesh(values.getMeshId(name));
#endif
}
