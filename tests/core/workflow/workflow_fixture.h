#pragma once

#include <QTemporaryDir>
#include <filesystem>
#include <string>

#include "core/store/study_file.h"
#include "core/workflow/study_design.h"
#include "tests/core/study/fake_engine.h"

namespace trapwright::fake {

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
