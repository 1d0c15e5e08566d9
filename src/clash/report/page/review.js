// What the reader says about clashes and groups: status, assignee, due date, comments. The page keeps
// it in this browser until it is saved as a file, which `abut review STORE --apply FILE` merges.

const TOPIC_STATUSES = ['open', 'assigned', 'resolved', 'closed', 'approved'];
const REVIEW_FIELDS = ['status', 'assignee', 'due'];

/** Edited topics by key: {group or clash, clashes, title, status, assignee, due, comments: [{text, time}]}. */
const edits = new Map();
let isSaved = true;

/** Reports with the same clashes share the edits that the browser keeps. */
const reviewKey = once(() => `abut-review:${JSON.stringify([report.files, count, report.id[0], report.id[count - 1]])}`);

/** Some browsers give a page from the disk no storage. */
function stored(action) {
  try {
    return action(localStorage);
  } catch {
    return null;
  }
}

const isText = (value) => typeof value === 'string';

/** Whether an entry that the browser kept is as keepEdits() writes it. Other programs can write there, too. */
function isEdit(entry) {
  if (!Array.isArray(entry) || !isText(entry[0]) || entry[1] === null || typeof entry[1] !== 'object')
    return false;
  const { comments, clashes, ...texts } = entry[1];
  return Object.values(texts).every(isText) && Array.isArray(comments) && comments.every((comment) => isText(comment?.text) && isText(comment.time)) &&
    (clashes === undefined || (Array.isArray(clashes) && clashes.every(isText)));
}

/** Returns the entries of what the browser kept; anything that is not a list is one unreadable entry. */
function parseEdits(text) {
  try {
    const entries = JSON.parse(text);
    return Array.isArray(entries) ? entries : [null];
  } catch {
    return [null];
  }
}

function readEdits() {
  const text = stored((storage) => storage.getItem(reviewKey()));
  const entries = text === null ? [] : parseEdits(text);
  const usable = entries.filter(isEdit);
  for (const [key, edit] of usable)
    edits.set(key, edit);
  isSaved = edits.size === 0;
  showSaveButton();
  if (usable.length === entries.length)
    return;
  // The text stays under another name, and this is said once: the next visit reads what is usable.
  stored((storage) => {
    storage.setItem(`${reviewKey()}:damaged`, text);
    storage.setItem(reviewKey(), JSON.stringify(usable));
  });
  showMessage(usable.length === 0 ? 'The review that this browser kept for the report is damaged and cannot be shown.'
    : `A part of the review that this browser kept for the report is damaged; ${usable.length === 1 ? '1 entry is' : `${wholeNumber.format(usable.length)} entries are`} intact.`);
}

/** Says something that the reader must see, until it is closed. */
function showMessage(text) {
  const [words, close] = byId('message').children;
  words.textContent = text;
  close.onclick = () => { byId('message').hidden = true; };
  byId('message').hidden = false;
}

function keepEdits() {
  isSaved = false;
  stored((storage) => storage.setItem(reviewKey(), JSON.stringify([...edits])));
  showSaveButton();
}

function showSaveButton() {
  byId('save').hidden = edits.size === 0;
  byId('save').textContent = `Save review (${wholeNumber.format(edits.size)})`;
}

/** The topic of a report's group or clash, as the command wrote it. */
const reportTopics = once(() => new Map((report.topics ?? []).map((topic) => [topic.group || topic.clashes?.[0], topic])));

function clashTopic(i) {
  return { key: `clash:${report.id[i]}`, clash: report.id[i], title: '', base: reportTopics().get(report.id[i]) };
}

function groupTopic(group) {
  const id = group.group?.id;
  if (id)
    return { key: `group:${id}`, group: id, title: group.name, base: reportTopics().get(id) };
  // A group that only the page made becomes a topic about its clashes.
  const clashes = group.clashes.map((i) => report.id[i]);
  return { key: `made:${group.key}`, clash: clashes[0], clashes, title: group.name };
}

/** The edit of a topic, made when something of it is edited. */
function editOf(topic) {
  if (!edits.has(topic.key)) {
    const { base } = topic;
    const { group, clash, clashes, title } = topic;
    edits.set(topic.key, {
      ...(base?.guid && { guid: base.guid }), ...(group && { group }), ...(clash && { clash }), ...(clashes && { clashes }),
      ...(!base && title && { title }), comments: [],
    });
  }
  return edits.get(topic.key);
}

const valueOf = (topic, field) => edits.get(topic.key)?.[field] ?? topic.base?.[field] ?? '';

/** Returns the section of the detail in which a topic is edited. */
function reviewSection(topic) {
  const set = (field) => (event) => {
    const edit = editOf(topic);
    edit[field] = event.target.value.trim();
    if (field === 'status' && edit.status === '')
      delete edit.status; // an empty status in the file would clear the one in the store
    keepEdits();
  };
  const field = (title, control, name) => {
    control.addEventListener('change', set(name));
    return make('label', {}, title, control);
  };
  const status = make('select', {}, make('option', { value: '' }, topic.base ? 'as it is' : 'none'),
    ...TOPIC_STATUSES.map((word) => make('option', { value: word }, word)));
  status.value = TOPIC_STATUSES.includes(valueOf(topic, 'status')) ? valueOf(topic, 'status') : '';
  const people = make('datalist', { id: 'people' }, ...knownPeople().map((name) => make('option', { value: name })));
  const assignee = make('input', { type: 'text', value: valueOf(topic, 'assignee'), autocomplete: 'off', maxLength: 200 });
  assignee.setAttribute('list', 'people');
  const author = make('input', { type: 'text', value: stored((storage) => storage.getItem('abut-author')) ?? '', autocomplete: 'name', maxLength: 200 });
  author.addEventListener('change', () => stored((storage) => storage.setItem('abut-author', author.value.trim())));
  const comments = make('ul', { className: 'comments' });
  const showComments = () => comments.replaceChildren(
    ...(topic.base?.comments ?? []).map(({ author, text }) => make('li', {}, make('b', {}, author || 'someone'), ` ${text}`)),
    ...(edits.get(topic.key)?.comments ?? []).map((comment) => make('li', { className: 'fresh' }, comment.text)));
  const text = make('textarea', { rows: 2, maxLength: 4000 });
  const add = make('button', { type: 'button' }, 'Add comment');
  add.addEventListener('click', () => {
    if (text.value.trim() === '')
      return text.focus();
    editOf(topic).comments.push({ text: text.value.trim(), time: new Date().toISOString().replace(/\.\d+Z$/, 'Z') });
    text.value = '';
    keepEdits();
    showComments();
    return announce('Comment added');
  });
  showComments();
  return make('section', { className: 'review' },
    make('h3', {}, 'Review'), people,
    make('div', { className: 'fields' },
      field('Status', status, 'status'), field('Assignee', assignee, 'assignee'),
      field('Due', make('input', { type: 'date', value: valueOf(topic, 'due') }), 'due'),
      make('label', {}, 'Your name', author)),
    comments,
    make('div', { className: 'comment' }, make('label', {}, 'Comment', text), add));
}

/** Names that were given as assignees before. */
function knownPeople() {
  const names = [...edits.values(), ...(report.topics ?? [])].map((topic) => topic.assignee).filter(Boolean);
  return [...new Set(names)].sort(byAlphabet);
}

/** The file of edits; docs/clash-report.md lists its keys. */
function reviewFile() {
  const topics = [...edits.values()].map(({ comments, ...topic }) => ({ ...topic, ...(comments.length > 0 && { comments }) }));
  const author = stored((storage) => storage.getItem('abut-author')) ?? '';
  return JSON.stringify({
    abut_review: 1, ...(report.store && { store: report.store }),
    ...(report.topics_revision !== undefined && { revision: report.topics_revision }), ...(author && { author }), topics,
  }, null, 1);
}

function saveFile(name, type, content) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  make('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

function startReview() {
  readEdits();
  byId('save').addEventListener('click', () => {
    saveFile('clash-review.json', 'application/json', reviewFile());
    isSaved = true;
    announce('Review saved');
  });
  addEventListener('beforeunload', (event) => {
    // What the browser itself keeps is not lost.
    if (!isSaved && stored((storage) => storage.getItem(reviewKey())) === null)
      event.preventDefault();
  });
}
