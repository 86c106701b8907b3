#include "ui/pages/stream_panel.h"

#include <algorithm>
#include <cmath>

#include "ui/charts/curve_chart.h"
#include "ui/charts/stream_sheet.h"
#include "ui/look/text.h"
#include "ui/pages/panel_head.h"

namespace trapwright::pages {

namespace {

QString percent(double share, int decimals = 1) {
    return QString::number(100.0 * share, 'f', decimals);
}

QString boundsText(double low, double high) {
    return QString("(%1 … %2)").arg(std::max(0.0, low), 0, 'f', 1).arg(high, 0, 'f', 1);
}

}  // namespace

StreamPanel::StreamPanel()
    : chart_(new charts::CurveChart("stream", tr("Stream"), this)),
      head_(new PanelHead("review.stream.head", this, chart_)) {
    setObjectName("review.streamPanel");
    setAccessibleName(tr("Stream of parts"));
    chart_->setEmptyText(
        tr("How many parts a minute this track delivers when they follow each other is not known yet. "
           "Simulate streams of parts to see it."));
    connect(head_, &QLabel::linkActivated, this, [this](const QString& link) { film(link.toUInt()); });
    connect(chart_, &charts::CurveChart::picked, this, [this](int x) {
        if (!streams_) return;
        const std::vector<study::StreamResult>& results = streams_->streams.results;
        const auto nearest = std::ranges::min_element(results, {}, [x](const study::StreamResult& result) {
            return std::abs(result.partsPerMinute - x);
        });
        film(static_cast<std::size_t>(nearest - results.begin()));
    });
    connect(chart_, &charts::ChartPanel::failed, this, &StreamPanel::failed);
    setStreams(nullptr);
}

void StreamPanel::setStreams(const study::StreamsRecord* streams) {
    streams_.reset();
    if (streams != nullptr) streams_ = *streams;
    head_->setVisible(streams_.has_value());
    chart_->setSheet(streams_ ? charts::streamSheet(streams_->streams) : charts::ChartSheet());
    if (streams_) showHead();
}

void StreamPanel::showHead() {
    const study::Streams& streams = streams_->streams;
    const study::StreamResult& best = *streams.findBest();
    const stats::MeanEstimate rate = best.rate(&study::StreamCounts::success);
    QString text =
        tr("<b>%1 parts a minute</b> as wanted %2 when %3 come")
            .arg(rate.mean, 0, 'f', 1)
            .arg(boundsText(rate.interval.low, rate.interval.high), look::numberText(best.partsPerMinute));
    if (const auto share = best.successShare())
        text += tr(": %1 % of those that arrive %2")
                    .arg(percent(share->mean),
                         boundsText(100.0 * share->interval.low, 100.0 * share->interval.high));
    text += ". ";
    const auto perMinute = [&](int study::StreamCounts::*count) {
        return QString::number(best.rate(count).mean, 'f', 1);
    };
    if (const auto efficiency = best.efficiency(); efficiency && best.sum().returned > 0)
        text += tr("%1 a minute fall back and come again, so that %2 % of all that come up are right. ")
                    .arg(perMinute(&study::StreamCounts::returned), percent(efficiency->mean));
    if (best.sum().fellOff > 0)
        text += tr("%1 a minute fall off and are lost. ").arg(perMinute(&study::StreamCounts::fellOff));
    const auto first = [&](auto&& condition) { return std::ranges::find_if(streams.results, condition); };
    if (const auto full = first([](const study::StreamResult& r) { return r.countFull() > 0; });
        full != streams.results.end())
        text += tr("At %1 a minute %2 of %3 streams are full: more come than get on. ")
                    .arg(look::numberText(full->partsPerMinute))
                    .arg(full->countFull())
                    .arg(full->streams.size());
    if (const auto jam = first([](const study::StreamResult& r) { return r.sum().uncleared > 0; });
        jam != streams.results.end())
        text += tr("At %1 a minute %2 of %3 streams end jammed. ")
                    .arg(look::numberText(jam->partsPerMinute))
                    .arg(jam->sum().uncleared)
                    .arg(jam->streams.size());
    QStringList films;
    for (std::size_t i = 0; i < streams.results.size(); ++i)
        films << QString("<a href=\"%1\">%2</a>")
                     .arg(i)
                     .arg(look::numberText(streams.results[i].partsPerMinute));
    text += tr("Watch %1 a minute. %2 streams of %3 s each, simulated by %4%5.")
                .arg(films.join(", "))
                .arg(streams.settings.streams)
                .arg(look::numberText(streams.settings.duration), QString::fromStdString(streams_->engine),
                     streams_->box ? tr(" over the operating box") : QString());
    head_->setText(text);
}

void StreamPanel::film(std::size_t result) {
    if (!streams_ || result >= streams_->streams.results.size()) return;
    workflow::StreamTrials trials{streams_->streams.settings, streams_->box, streams_->streams.goal,
                                  streams_->engine};
    trials.settings.partsPerMinute = streams_->streams.results[result].partsPerMinute;
    emit filmWanted(trials, tr("Stream, %1 a minute").arg(look::numberText(trials.settings.partsPerMinute)));
}

}  // namespace trapwright::pages
