// Quiz: before some blocks the replay stops and asks; the answer is weighed, and the replay goes on and shows it.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});

  /** Quiz in `box` {panel, ask, answers, said, go, score}, over a player. */
  function quiz({ panel, count, ask, answers, said, go }, doc, player) {
    const { border_s: border } = doc.blocks;
    const given = new Map(); // question to whether its answer was right
    let isOn = false;
    let open = null;
    let chosen = null;
    let score = null; // {right, all} of a quiz that is done
    const { pick, say } = Drycut.language;

    /** How many were right. */
    const right = () => [...given.values()].filter(Boolean).length;

    /** Write what is open, in the language of the page: a question and what came of its answer, or the score. */
    function write() {
      if (open) writeQuestion();
      else if (score) writeScore();
    }

    /** Write a question. */
    function writeQuestion() {
      const number = doc.quiz.indexOf(open) + 1;
      count.textContent = say("question", { number, all: doc.quiz.length });
      ask.textContent = pick(open.ask);
      answers.replaceChildren(...open.answers.map((answer, at) => answerButton(answer, at)));
      said.textContent = chosen === null ? "" : verdict();
      said.className = chosen === null ? "" : chosen === open.right ? "right" : "wrong";
      go.hidden = chosen === null;
    }

    /** Whether the answer was right, and why. */
    function verdict() {
      const first = chosen === open.right ? say("right") : say("wrong");
      return [first, pick(open.why)].filter(Boolean).join(" ");
    }

    /** One answer as a button. */
    function answerButton(answer, at) {
      const button = Drycut.element("button", "answer");
      button.append(Drycut.element("span", "key", at + 1), pick(answer));
      button.type = "button";
      button.disabled = chosen !== null;
      if (chosen !== null && at === open.right) button.classList.add("right");
      else if (chosen === at) button.classList.add("wrong");
      button.addEventListener("click", () => choose(at));
      return button;
    }

    /** Take an answer. */
    function choose(at) {
      if (!open || chosen !== null || at >= open.answers.length) return;
      chosen = at;
      given.set(open, at === open.right);
      write();
      go.focus();
    }

    /** Ask a question. */
    function show(question) {
      open = question;
      chosen = null;
      panel.hidden = false;
      write();
      answers.querySelector("button").focus();
    }

    /** Write the score. */
    function writeScore() {
      count.textContent = say("quiz_finished");
      ask.textContent = say("score", score);
      answers.replaceChildren();
      said.textContent = "";
      go.hidden = false;
    }

    /** The score, once all were asked; the next quiz begins anew. */
    function showScore() {
      score = { right: right(), all: given.size };
      given.clear();
      panel.hidden = false;
      write();
      go.focus();
    }

    /** Go on after an answer; after the last one with the score. */
    function goOn() {
      const wasQuestion = open !== null;
      open = null;
      panel.hidden = true;
      if (wasQuestion) player.play();
    }

    for (const question of doc.quiz) {
      const t = Math.min(border[question.row], player.duration);
      player.addGate({ t, isShut: () => isOn && !given.has(question), reached: () => show(question) });
    }
    player.addGate({
      t: player.duration,
      isShut: () => isOn && given.size === doc.quiz.length && given.size > 0,
      reached: showScore,
    });
    go.addEventListener("click", goOn);
    Drycut.language.onChange(write);

    return {
      get isOn() { return isOn; },
      get isOpen() { return !panel.hidden; },
      /** Begin the quiz from the start of the run, or end it. */
      toggle() {
        isOn = !isOn;
        given.clear();
        open = null;
        panel.hidden = true;
        player.seek(0);
        if (isOn) player.play();
        else player.pause();
      },
      choose,
    };
  }

  Drycut.quiz = quiz;
})(globalThis);
