// The list of chapters: the one that is being read is marked, and in sight where the list is longer than the screen is wide.
{
  const chapters = [...document.querySelectorAll('.chapter')], list = document.querySelector('.contents ol');
  const links = chapters.map(chapter => list.querySelector(`a[href="#${chapter.id}"]`));
  let marked = null;
  const mark = () => {
    const read = Math.max(0, chapters.findLastIndex(chapter => chapter.getBoundingClientRect().top < innerHeight / 3));
    if (links[read] === marked) return;
    marked?.removeAttribute('aria-current');
    marked = links[read];
    marked.setAttribute('aria-current', 'true');
    list.scrollTo({ left: marked.offsetLeft - (list.clientWidth - marked.offsetWidth) / 2 });
  };
  addEventListener('scroll', mark, { passive: true });
  mark();
}
