#pragma once

#include <QTemporaryDir>
#include <filesystem>
#include <string>

#include "core/store/study_file.h"
#include "core/workflow/study_design.h"
#include "core/workflow/study_engines.h"
#include "tests/core/study/fake_engine.h"

namespace trapwright::fake {

/// Knows the engines "native" and "simbody", which both judge by the law.
inline workflow::EngineMaker engineMaker(const Law& law = waveLaw) {
    return [law](const std::string& name,
                 const trial::EngineOptions& options) -> base::Result<std::shared_ptr<const trial::Engine>> {
        if (name != "native" && name != "simbody") return base::Error{"There is no engine " + name + "."};
        auto engine = std::make_shared<FakeEngine>(law, options.threads);
        engine->title = name;
        return std::shared_ptr<const trial::Engine>(engine);
    };
}

/// A study of the block on the wave, in a folder of its own.
class WaveStudy {
 public:
    explicit WaveStudy(const std::string& engine, int generations = 3) : inputs(waveInputs()) {
        inputs.settings.evolution.generations = generations;
        inputs.settings.simulation.engine = engine;
        store::StoredPart part;
        part.options.name = "block";
        path = std::filesystem::path(folder_.path().toStdString()) / "wave.trap";
        file = std::make_unique<store::StudyFile>(
            store::StudyFile::create(path, inputs.settings, part, "test").value());
    }

    study::StudyInputs inputs;
    std::filesystem::path path;
    std::unique_ptr<store::StudyFile> file;

 private:
    QTemporaryDir folder_;
};

}  // namespace trapwright::fake
