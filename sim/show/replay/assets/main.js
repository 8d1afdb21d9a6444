// Puts the page together: reads the document, and draws a frame whenever something has changed.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const find = (id) => document.getElementById(id);

  /** The player's part for tests and other scripts. */
  function publish(player, view) {
    const { seek, seekBlock, seekStep, stepBy, blockBy, play, pause, setSpeed, setLoop, state, duration } = player;
    Object.assign(Drycut.player, { seek, seekBlock, seekStep, stepBy, blockBy, play, pause, setSpeed, setLoop, state, duration, view });
  }

  /** What the page itself remembers: whether it follows the wire, and how much deviations are magnified. */
  function pageState(redraw) {
    const select = find("magnify");
    const button = document.querySelector('[data-do="follow"]');
    const help = find("help");
    const page = {
      isFollowing: false,
      times: 0,
      follow(isOn) {
        page.isFollowing = isOn;
        button.setAttribute("aria-pressed", isOn);
      },
      magnify(times) {
        page.times = times;
        select.value = String(times);
      },
      help(isOpen) {
        if (isOpen) help.showModal();
        else help.close();
      },
    };
    select.addEventListener("change", () => {
      page.magnify(Number(select.value));
      redraw();
    });
    return page;
  }

  /** Say the block while the replay stands, for those who cannot see it. */
  function announcer(box, doc) {
    let said = null;
    return (state) => {
      if (state.playing) return;
      const text = Drycut.words.block(doc.blocks, state.block);
      if (text !== said) box.textContent = text;
      said = text;
    };
  }

  /** Everything of a replay that is drawn or written, and `frame(now)`, which does it. */
  function build(replay) {
    const { doc } = replay;
    const model = Drycut.model(replay);
    const player = Drycut.playerOf(replay, model);
    let wanted = 0; // the frame that is asked for, if any
    let last = null;

    /** Ask for a frame. */
    function redraw() {
      if (!wanted) wanted = requestAnimationFrame(frame);
    }

    const page = pageState(redraw);
    const stage = Drycut.stage(find("table"), replay, model, redraw);
    const quiz = Drycut.quiz(
      { panel: find("quiz"), count: find("quiz-count"), ask: find("quiz-ask"), answers: find("quiz-answers"), said: find("quiz-said"), go: find("quiz-go") },
      doc,
      player,
    );
    const actions = Drycut.actionsOf({ player, stage, quiz, page, redraw });
    const outs = Drycut.readouts(document.body, doc, model);
    const tip = Drycut.tip(find("tip"));
    const onFinding = ({ row, t_s: t }) => {
      if (row !== null && t === doc.blocks.border_s[row]) player.seekBlock(row); // which may take no time at all
      else player.seek(t);
    };
    const timeline = Drycut.timeline(
      { bar: find("bar"), marks: find("marks"), cursor: find("cursor"), findings: find("finding-marks") },
      doc,
      player,
      stage.colours,
      { onSeek: player.seek, onFinding },
    );
    const list = Drycut.findings(find("findings"), doc, onFinding);
    const text = Drycut.program(find("program"), doc, {
      onPick: player.seekBlock,
      onHover(row, event) {
        stage.outline(row);
        if (row === null) tip.hide();
        else tip.show(Drycut.words.block(doc.blocks, row), Drycut.words.geometry(doc.blocks, row), event.clientX, event.clientY);
      },
    });
    const announce = announcer(find("live"), doc);

    /** Say where a time is on the bar. */
    function showTime(state) {
      const bar = find("bar");
      bar.setAttribute("aria-valuenow", state.t.toFixed(3));
      bar.setAttribute("aria-valuetext", Drycut.words.clock(state.t));
      timeline.at(state.t);
    }

    /** One frame: let time go by, and show the moment. */
    function frame(now) {
      wanted = 0;
      const wasPlaying = player.playing;
      player.advance(last === null ? 0 : (now - last) / 1000);
      const state = player.state();
      state.deviation = model.deviation(state.t);
      state.isAsked = quiz.isOpen;
      if (page.isFollowing) stage.view.lookAt(...state.wire);
      const falls = wasPlaying || (stage.isFalling && state.t >= player.duration); // on after the end
      stage.draw(state, page.times, falls, now);
      outs.show(state);
      text.run(state.block);
      showTime(state);
      announce(state);
      last = player.playing || stage.isFalling ? now : null;
      if (last !== null) redraw();
    }

    player.onChange(() => {
      Drycut.showPlayer(player);
      find("quiz-on").setAttribute("aria-pressed", quiz.isOn);
      timeline.loop(player.loop);
      redraw();
    });
    Drycut.pointer(find("table"), stage.view, (isPan) => {
      if (isPan) page.follow(false);
      redraw();
    });
    Drycut.wireButtons(actions);
    Drycut.wireTabs([...document.querySelectorAll('[role="tab"]')]);
    Drycut.wireSpeed(find("speed"), find("speed-shown"), player);
    Drycut.keys(actions, quiz);
    Drycut.language.onChange(() => {
      list.write();
      timeline.redo();
      redraw();
    });
    root.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", timeline.redo);
    find("bar").setAttribute("aria-valuemax", player.duration);
    publish(player, stage.view);
    find("loading").hidden = true;
    Drycut.showPlayer(player);
    redraw();
  }

  /** Decode and build; what goes wrong stands in the page. */
  async function start() {
    try {
      build(await Drycut.decode(JSON.parse(find("document").textContent)));
    } catch (error) {
      find("loading").textContent = Drycut.language.say("cannot_play", { error });
      throw error;
    }
  }

  Drycut.player = { ready: null };
  Drycut.player.ready = start();
})(globalThis);
